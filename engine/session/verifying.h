#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/session/guidance.h"
#include "engine/session/method.h"
#include "engine/session/session_options.h"
#include "engine/session/touch.h"
#include "nav/registration/pressed_places.h"

namespace orthonav::engine {

/// The step in which one registration is verified, by eye and by touch. Another registration is
/// another object.
class Verifying {
 public:
  Verifying() = default;  ///< nothing was registered
  /// Of the level's registration and the points that it was made of; both are there.
  /// `anchored`: to a patient reference. On the map, which moves while touches go on, three spread
  /// places are enough, and each is taken to be as the model has the bone.
  Verifying(LevelState& level, Verification verification, const SessionOptions& options,
            bool anchored, Timestamp registered);

  /// Of the registration that was accepted, once something moved by so much since: what was touched
  /// before is no check any more. With a reference it stays in the estimate.
  void begin_again(LevelState& level, double moved_m);

  /// The registration is shown then, if it was not before.
  void show(Timestamp display_time);
  /// What was said before the registration was first shown can't be a judgement of it.
  [[nodiscard]] bool shown_before(Timestamp spoken) const;

  [[nodiscard]] Touch& touch() { return touch_; }
  /// Adds a check point, or says why there is none.
  [[nodiscard]] std::optional<TouchRefusal> record(LevelState& level, const TouchedPlace& place,
                                                   Timestamp time);
  /// Takes the last one back; false when there is none.
  [[nodiscard]] bool drop(LevelState& level);
  [[nodiscard]] const nav::CheckVerdict& verdict() const { return verdict_; }
  /// The level's registration takes in what was touched.
  void join(LevelState& level) const;

  /// How far the points of the registration lie from its surface, in their order.
  [[nodiscard]] std::span<const float> residuals_m() const { return residuals_m_; }
  [[nodiscard]] std::span<const float> unstroked() const { return unstroked_; }
  [[nodiscard]] std::span<const Point<World>> to_check() const { return to_check_; }
  /// Of a registration that is verified by touch.
  [[nodiscard]] ChecksSoFar state(const LevelState& level) const;

 private:
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
  std::vector<float> residuals_m_;
  std::vector<float> unstroked_;
  std::vector<Point<World>> places_;    ///< proposed to be touched first
  std::vector<Point<World>> to_check_;  ///< of them those that were not touched yet, or one more
  nav::CheckVerdict verdict_;           ///< on the check points so far
  std::optional<double> moved_m_;       ///< since it was accepted
  std::optional<Timestamp> visible_at_;
  Touch touch_;
};

}  // namespace orthonav::engine
