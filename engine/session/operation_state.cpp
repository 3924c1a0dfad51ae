#include "engine/session/operation_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orthonav::engine {

double BoneFound::drift_sd_m(Timestamp now) const {
  return drift_m_per_sqrt_s * std::sqrt(std::max(0.0, seconds(now - time)));
}

double BoneFound::sd_at_m(Timestamp now) const { return std::hypot(sd_m, drift_sd_m(now)); }

BoneFound found_by_landmark(const BoneFound& before, const LandmarkTouch& touch,
                            const Landmark& landmark, Timestamp now) {
  BoneFound found{now, before.sd_at_m(now), before.drift_m_per_sqrt_s};
  if (!touch.first) {
    const double off_sd_m = touch.off_m / std::sqrt(3.0);
    found.sd_m = std::min(found.sd_m, std::hypot(landmark.bone_sd_m, off_sd_m, touch.sd_m));
  }
  return found;
}

void OperationState::forget_places() {
  for (LevelState& level : levels) {
    level.map_moved = level.registration.has_value() && level.finished();
    if (!level.map_moved) {
      level.forget_registration();
    }
  }
  for (RodState& rod : rods) {
    rod.map_moved = rod.done;
  }
  forget_open_rods();
}

void OperationState::forget_open_rods() {
  for (RodState& rod : rods) {
    if (!rod.done) {
      rod = RodState{.side = rod.side};
    }
  }
}

LevelState planned_level(OperatedLevel plan) {
  LevelState level;
  for (const nav::ScrewPlan& screw : plan.screws) {
    level.screws.emplace_back().preoperative = screw;
  }
  level.plan = std::move(plan);
  return level;
}

}  // namespace orthonav::engine
