#include "engine/operation_result.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {

OperationResult outcome_of(std::span<const LevelState> levels, std::span<const RodState> rods,
                           LoopReport loop) {
  OperationResult result;
  result.completed = loop.done;
  for (const LevelState& state : levels) {
    LevelOutcome level;
    level.label = state.plan.label;
    level.accepted = state.accepted;
    level.attempts = state.attempts;
    if (state.registration) {
      level.rmse_m = state.registration->rmse_m;
      level.predicted_tre_m = nav::worst_m(state.predicted);
      level.points = state.registration->points;
      level.digitization_s = state.digitization_s;
    }
    for (std::size_t s = 0; s < state.plan.screws.size(); ++s) {
      level.screws.push_back({state.plan.screws[s].side, state.screw_done[s], {}, {}});
      result.completed = result.completed && state.screw_done[s];
    }
    result.completed = result.completed && level.accepted;
    result.levels.push_back(std::move(level));
  }
  for (const RodState& rod : rods) {
    RodOutcome outcome;
    outcome.side = rod.side;
    outcome.heads = rod.heads.size();
    if (rod.rod) outcome.length_m = rod.rod->length_m;
    result.rods.push_back(outcome);
  }
  result.loop = std::move(loop);
  return result;
}

}  // namespace orthonav::engine
