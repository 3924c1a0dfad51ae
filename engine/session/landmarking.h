#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <variant>

#include "engine/session/operation_in_work.h"

namespace orthonav::engine {

class GuideChecks;
class Guiding;
class Verifying;

/// The step `accepted` where registrations are verified by touch: the landmark of the level is
/// touched before its next screw, and once in an operation the guide's tip is put into it. Before
/// another screw it is another object: no touch so far says anything of where the bone is now.
class Landmarking {
 public:
  explicit Landmarking(const LandmarkRules& rules) : rules_(rules) {}

  void begin_touch();
  void end_touch();
  void drop_touch(OperationInWork& work, Timestamp time);
  /// Once for each pair of the step.
  void collect(const WatchedTools& tools);
  /// What was pressed is the landmark, or the guide's tip in it.
  [[nodiscard]] std::optional<Event> touch_landmark(OperationInWork& work, GuideChecks& guide,
                                                    Timestamp time);
  /// Takes back what was touched since the step began, and with a first place the landmark.
  void drop_landmark(OperationInWork& work, Timestamp time);
  [[nodiscard]] Event judge_landmark() const {
    return touched() ? Event::kLandmarkTouched : Event::kLandmarkMissing;
  }
  /// The landmark has moved, and it stays: what is accepted next must put the bone where it was
  /// touched first.
  void verify_again(OperationInWork& work, Verifying& verifying, Guiding& guiding,
                    Timestamp time) const;

  /// Records the level's landmark, or compares with it, once touched often enough; or says why the
  /// touch does not count. The level has a registration; `posts` are the patient references, none
  /// where World is the map.
  [[nodiscard]] std::variant<LandmarkTouch, TouchRefusal> take(LevelState& level,
                                                               const TouchedPlace& place,
                                                               std::span<const ReferencePost> posts,
                                                               bool anchored, Timestamp time);
  /// Since the step began, and found where it was.
  [[nodiscard]] bool touched() const { return last_ && last_->held(); }
  [[nodiscard]] StepState state(const OperationInWork& work, const GuideChecks& guide) const;

 private:
  [[nodiscard]] std::optional<TouchRefusal> refusal_of(const LevelState& level,
                                                       const nav::PressedPlace& place,
                                                       Point<Vertebra> here,
                                                       std::span<const ReferencePost> posts,
                                                       bool anchored);
  [[nodiscard]] std::optional<TouchRefusal> too_near(const LevelState& level, Point<World> place,
                                                     std::span<const ReferencePost> posts) const;
  /// Where it was touched, in the vertebra: the mean of the touches so far, and its SD along an
  /// axis; there is one.
  [[nodiscard]] Point<Vertebra> mean_place() const { return {sum_m_ / touches_}; }
  [[nodiscard]] double sd_m() const { return std::sqrt(variances_m2_) / touches_; }
  [[nodiscard]] std::optional<nav::PressedPlace> guide_tip_in_landmark(const OperationInWork& work,
                                                                       const TouchedPlace& pointer);
  [[nodiscard]] nav::PressedPlace place_in_world(const LevelState& level) const;
  void forget_touches();

  LandmarkRules rules_;
  std::optional<LandmarkTouch> last_;
  bool recorded_here_ = false;  ///< since the step began
  Vec3 sum_m_;                  ///< of the touches so far, in Vertebra
  double variances_m2_ = 0.0;
  int touches_ = 0;
  Touch pointer_;
  Touch guide_;
};

}  // namespace orthonav::engine
