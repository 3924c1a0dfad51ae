#include "engine/session/operation_state.h"

#include <utility>

namespace orthonav::engine {

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
