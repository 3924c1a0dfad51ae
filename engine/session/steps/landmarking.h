#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <variant>

#include "engine/session/log/operation_json.h"
#include "engine/session/session_state.h"
#include "engine/session/text/status_line.h"

namespace orthonav::engine {

class GuideChecks;
class Guiding;
class Verifying;

/// The step `landmark` when registrations are verified by touch: the landmark of the level is
/// touched before its next screw, and the guide's tip is put into it (TipCheck says when). A new
/// object is made before each screw, because earlier touches do not show where the bone is now.
class Landmarking {
 public:
  /// Takes the pressed place as the landmark, or as the guide's tip in it.
  [[nodiscard]] std::optional<Event> touch_landmark(SessionState& work, GuideChecks& guide,
                                                    Timestamp time);
  /// Takes back the touches since the step began, and the landmark if they recorded it.
  void drop_landmark(SessionState& work, Timestamp time);
  /// The landmark has moved. It is kept: the next accepted registration must put the bone where the
  /// landmark was touched first.
  void verify_again(SessionState& work, Verifying& verifying, Guiding& guiding,
                    Timestamp time) const;

  /// Records the level's landmark, or compares with it, once touched often enough; or returns why
  /// the touch does not count. The level has a registration; `posts` are the patient references,
  /// none if World is the map.
  [[nodiscard]] std::variant<LandmarkTouch, TouchRefusal> take(LevelState& level,
                                                               const TouchedPlace& place,
                                                               std::span<const ReferencePost> posts,
                                                               bool anchored, Timestamp time);
  /// Whether the landmark was touched since the step began, and found where it was.
  [[nodiscard]] bool touched() const { return last_ && last_->held(); }
  [[nodiscard]] StepState state(const SessionState& work, const GuideChecks& guide) const;

 private:
  [[nodiscard]] std::optional<TouchRefusal> refusal_of(const LevelState& level,
                                                       const nav::PressedPlace& place,
                                                       Point<Vertebra> here,
                                                       std::span<const ReferencePost> posts,
                                                       bool anchored);
  [[nodiscard]] std::optional<TouchRefusal> too_near(const LevelState& level, Point<World> place,
                                                     std::span<const ReferencePost> posts) const;
  /// Mean of the touches so far, in the vertebra, and its SD along an axis; requires a touch.
  [[nodiscard]] Point<Vertebra> mean_place() const { return {sum_m_ / touches_}; }
  [[nodiscard]] double sd_m() const { return std::sqrt(variances_m2_) / touches_; }
  [[nodiscard]] std::optional<nav::PressedPlace> guide_tip_in_landmark(
      SessionState& work, const TouchedPlace& pointer) const;
  [[nodiscard]] nav::PressedPlace place_in_world(const LevelState& level) const;
  void forget_touches();

  std::optional<LandmarkTouch> last_;
  bool recorded_here_ = false;  ///< since the step began
  Vec3 sum_m_;                  ///< of the touches so far, in Vertebra
  double variances_m2_ = 0.0;
  int touches_ = 0;
};

// Its records in the log; `json` holds time and level already.

void log_landmark_touch(LogJson& json, const LevelState& level, const LandmarkTouch& touch);
[[nodiscard]] LandmarkTouch read_landmark_touch(const JsonNode& node, LevelState& level);
void log_landmark_dropped(LogJson& json, const LevelState& level);
void read_landmark_dropped(const JsonNode& node, LevelState& level);
/// The landmark had moved.
void read_acceptance_withdrawn(LevelState& level);

void write(PartedText text, const LandmarkMissing& m);
void write(PartedText text, const LandmarkMoved& m);
void write(PartedText text, const BoneUnchecked& m);
/// Whether the landmark is still to be touched, and the result of the last touch.
void write_landmark(PartedText text, const LandmarkSoFar& landmark, std::string_view separator);

}  // namespace orthonav::engine
