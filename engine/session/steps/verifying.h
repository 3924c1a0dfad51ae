#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/session/log/operation_json.h"
#include "engine/session/session_state.h"
#include "engine/session/text/status_line.h"
#include "nav/registration/presses.h"

namespace orthonav::engine {

/// The step in which one registration is verified, by eye and by touch. Each registration has its
/// own object.
class Verifying {
 public:
  Verifying() = default;  ///< nothing was registered
  /// Verifies the level's registration with the points it was computed from; both must exist. With
  /// a patient reference many places are asked for; on the map, which moves while places are
  /// touched, three that are far apart are enough, and each is assumed to lie on the model's
  /// surface. `before`: the object in force until now; what `rejected` left in it counts.
  Verifying(SessionState& work, Timestamp registered, Verifying before);
  /// The surgeon rejects the level. If only the error at the screws spoke against it, the touched
  /// places still show where the bone is: they count in the level's next registration. On the map,
  /// which moves, none does.
  [[nodiscard]] Verifying rejected(const SessionState& work) &&;

  /// Verifies the accepted registration again after a movement by `moved_m`: the places touched
  /// before are no longer checks. With a reference they remain in the estimate.
  void begin_again(LevelState& level, double moved_m);
  /// Adds the touched place to the level's check points.
  void record_check(SessionState& work, Timestamp time);
  /// Takes the last check point back.
  void drop_check(SessionState& work, Timestamp time);
  /// Whether the registration was shown by then: what was said before can't be a judgement of it.
  [[nodiscard]] bool shown_by(Timestamp said) const { return visible_at_ && *visible_at_ <= said; }
  /// The check points confirm it, or the eye alone verifies.
  [[nodiscard]] bool passed() const { return verdict_.passed || !by_touch_; }
  [[nodiscard]] const nav::CheckVerdict& verdict() const { return verdict_; }
  /// The level's registration includes the touched places and is in force from now on.
  void accept(SessionState& work, Timestamp time) const;

  /// In its step, the registration is shown from now on, unless something hangs.
  void write(const SessionState& work, Guidance& out);
  /// Notes the status line shown with the registration.
  void note_shown(const StatusLine& line);
  [[nodiscard]] StepState state(const SessionState& work) const;

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
  std::optional<nav::Registration> strokes_;   ///< from the strokes alone
  /// The level's check points, after those of earlier verifications.
  std::vector<nav::PressedPlace> pressed_;
  std::size_t pressed_on_ = 0;  ///< the level, by its number in the operation
  Timestamp registered_{};
  std::optional<nav::Registration> joined_;  ///< with the places; nothing if they can't be fitted
  std::optional<nav::NextPlace> next_;       ///< the most useful one to touch next
  std::vector<float> residuals_m_;           ///< of its points from the surface, in order
  std::vector<float> unstroked_;
  std::vector<Point<World>> places_;    ///< proposed to be touched first
  std::vector<Point<World>> to_check_;  ///< those of `places_` not touched yet, or one more
  nav::CheckVerdict verdict_;           ///< about the check points so far
  std::optional<double> moved_m_;       ///< since it was accepted
  std::optional<Timestamp> visible_at_;
  std::string shown_;  ///< the status line as last shown
};

// Its records in the log; `json` holds time and level already.

/// Of the newest check point.
void log_check_point(LogJson& json, const LevelState& level);
void read_check_point(const JsonNode& node, LevelState& level);
/// The newest was taken back.
void read_check_point_dropped(LevelState& level);
/// `shown`: the status line as last shown.
void log_acceptance(LogJson& json, const LevelState& level, std::string_view shown);
void read_acceptance(const JsonNode& node, LevelState& level);

/// What is wrong with the check points, and what to do; nothing if all is well.
[[nodiscard]] std::string text_of(const nav::CheckAdvice& advice);
void write(PartedText text, const SaidBeforeShown& m);
void write(PartedText text, const ChecksMissing& m);
/// What is to be touched, and how far the landmark has moved since the registration was accepted.
void write_checks(PartedText text, const ChecksSoFar& checks, std::string_view separator);

}  // namespace orthonav::engine
