#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "engine/session/guidance.h"
#include "engine/session/touch.h"

namespace orthonav::engine {

/// A patient reference where it is clamped, from its tag down to its foot.
struct ReferencePost {
  Point<World> tag;
  Point<World> foot;
};

/// The step `accepted` where registrations are verified by touch: the landmark of the level is
/// touched before its next screw.
class Landmarking {
 public:
  Landmarking() = default;
  explicit Landmarking(const LandmarkRules& rules) : rules_(rules) {}

  /// A screw is to follow: no touch so far, and no press, says anything of where the bone is now.
  void begin();
  [[nodiscard]] Touch& touch() { return touch_; }
  /// Records the level's landmark, or compares with it, once touched often enough; or says why the
  /// touch does not count. The level has a registration; `posts` are the patient references, none
  /// where World is the map.
  [[nodiscard]] std::variant<LandmarkTouch, TouchRefusal> take(LevelState& level,
                                                               const TouchedPlace& place,
                                                               std::span<const ReferencePost> posts,
                                                               bool anchored, Timestamp time);
  enum class Dropped : std::uint8_t { kNothing, kTouch, kPlace };
  /// Takes back what was touched since the step began, and with a first place the landmark; it had
  /// been touched too seldom (`kTouch`) or often enough (`kPlace`).
  [[nodiscard]] Dropped drop(LevelState& level);
  /// Since the step began, and found where it was.
  [[nodiscard]] bool touched() const { return last_ && last_->held(); }
  /// Where, in the vertebra: the mean of the touches so far, and its SD along an axis; there is
  /// one.
  [[nodiscard]] Point<Vertebra> mean_place() const { return {sum_m_ / touches_}; }
  [[nodiscard]] double sd_m() const { return std::sqrt(variances_m2_) / touches_; }
  [[nodiscard]] const std::optional<LandmarkTouch>& last() const { return last_; }

 private:
  [[nodiscard]] std::optional<TouchRefusal> refusal_of(const LevelState& level,
                                                       const nav::PressedPlace& place,
                                                       Point<Vertebra> here,
                                                       std::span<const ReferencePost> posts,
                                                       bool anchored);
  [[nodiscard]] std::optional<TouchRefusal> too_near(const LevelState& level, Point<World> place,
                                                     std::span<const ReferencePost> posts) const;

  void forget_touches();

  LandmarkRules rules_;
  std::optional<LandmarkTouch> last_;
  bool recorded_here_ = false;  ///< since the step began
  Vec3 sum_m_;                  ///< of the touches so far, in Vertebra
  double variances_m2_ = 0.0;
  int touches_ = 0;
  Touch touch_;
};

}  // namespace orthonav::engine
