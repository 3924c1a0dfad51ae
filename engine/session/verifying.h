#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/session/guidance.h"
#include "engine/session/method.h"
#include "engine/session/touch.h"

namespace orthonav::engine {

/// The step in which one registration is verified, by eye and by touch. Another registration is
/// another object.
class Verifying {
 public:
  Verifying() = default;  ///< nothing was registered
  /// Of the level's registration and the points that it was made of; both are there.
  Verifying(const LevelState& level, Verification verification, const nav::CheckPointRules& rules);

  /// The registration is shown then, if it was not before.
  void show(Timestamp display_time);
  /// What was said before the registration was first shown can't be a judgement of it.
  [[nodiscard]] bool shown_before(Timestamp spoken) const;

  [[nodiscard]] Touch& touch() { return touch_; }
  /// Adds a check point, or says why there is none.
  [[nodiscard]] std::optional<TouchRefusal> record(LevelState& level, const TouchedPlace& place);
  /// Takes the last one back; false when there is none.
  [[nodiscard]] bool drop(LevelState& level);
  [[nodiscard]] const nav::CheckVerdict& verdict() const { return verdict_; }

  /// How far the points of the registration lie from its surface, in their order.
  [[nodiscard]] std::span<const float> residuals_m() const { return residuals_m_; }
  [[nodiscard]] std::span<const float> unstroked() const { return unstroked_; }
  [[nodiscard]] std::span<const Point<World>> to_check() const { return to_check_; }
  /// Of a registration that is verified by touch.
  [[nodiscard]] ChecksSoFar state(const LevelState& level) const;

 private:
  void judge(const LevelState& level);

  nav::CheckPointRules rules_;
  std::vector<float> residuals_m_;
  std::vector<float> unstroked_;
  std::vector<Point<World>> places_;    ///< proposed to be touched
  std::vector<Point<World>> to_check_;  ///< of them those that were not touched yet
  nav::CheckVerdict verdict_;           ///< on the check points so far
  std::optional<Timestamp> visible_at_;
  Touch touch_;
};

}  // namespace orthonav::engine
