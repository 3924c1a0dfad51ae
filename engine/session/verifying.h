#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/session/operation_in_work.h"
#include "nav/registration/pressed_places.h"

namespace orthonav::engine {

/// The step in which one registration is verified, by eye and by touch. Another registration is
/// another object.
class Verifying {
 public:
  Verifying() = default;  ///< nothing was registered
  /// Of the level's registration and the points that it was made of; both are there. With a patient
  /// reference many places are asked for; on the map, which moves while touches go on, three spread
  /// ones are enough, and each is taken to be as the model has the bone.
  Verifying(OperationInWork& work, Timestamp registered);

  /// Of the registration that was accepted, once something moved by so much since: what was touched
  /// before is no check any more. With a reference it stays in the estimate.
  void begin_again(LevelState& level, double moved_m);
  /// What was said before the registration was first shown can't be a judgement of it.
  [[nodiscard]] bool shown_before(Timestamp spoken) const;

  void begin_touch() { touch_.begin(); }
  void end_touch() { touch_.release(); }
  void drop_touch(OperationInWork& work, Timestamp time);
  /// Once for each pair of the step.
  void collect(const WatchedTools& tools) { add_tip(touch_, tools, tools.pointer()); }
  /// Adds the place that was touched to the level's check points.
  void record_check(OperationInWork& work, Timestamp time);
  /// Takes the last one back.
  void drop_check(OperationInWork& work, Timestamp time);
  [[nodiscard]] Event judge_checks() const {
    return verdict_.passed ? Event::kChecked : Event::kNotChecked;
  }
  [[nodiscard]] const nav::CheckVerdict& verdict() const { return verdict_; }
  /// The level's registration takes in what was touched, and holds from now on.
  void accept(OperationInWork& work, Timestamp time) const;

  /// In its step: the registration is shown from now on, unless something hangs.
  void write(const OperationInWork& work, Guidance& out);
  /// What the surgeon is shown beside it.
  void note_shown(const StatusLine& line);
  [[nodiscard]] StepState state(const OperationInWork& work) const;

 private:
  [[nodiscard]] std::optional<TouchRefusal> add(LevelState& level, const TouchedPlace& place,
                                                Timestamp time);
  void judge(LevelState& level);
  [[nodiscard]] nav::PressModel press_model() const;
  void propose(const LevelState& level);
  static void put(const nav::Registration& registration, LevelState& level);

  SessionOptions options_;
  bool by_touch_ = false;
  bool anchored_ = false;
  nav::PoseSearchRegistrationOptions limits_;  ///< with the level's screws
  std::optional<nav::Registration> strokes_;   ///< what the strokes alone say
  /// The level's check points, after those by which it was verified before.
  std::vector<nav::PressedPlace> pressed_;
  Timestamp registered_{};
  std::optional<nav::JoinedPlaces> joined_;  ///< of both; nothing where they can't be joined
  std::optional<nav::NextPlace> next_;       ///< most worth touching after them
  std::vector<float> residuals_m_;           ///< of its points from the surface, in their order
  std::vector<float> unstroked_;
  std::vector<Point<World>> places_;    ///< proposed to be touched first
  std::vector<Point<World>> to_check_;  ///< of them those that were not touched yet, or one more
  nav::CheckVerdict verdict_;           ///< on the check points so far
  std::optional<double> moved_m_;       ///< since it was accepted
  std::optional<Timestamp> visible_at_;
  std::string shown_;  ///< the status line, as it was shown last
  Touch touch_;
};

}  // namespace orthonav::engine
