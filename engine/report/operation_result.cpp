#include "engine/report/operation_result.h"

#include <algorithm>
#include <cmath>

#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

/// The level's outcome without its screws.
LevelOutcome outcome_of(const LevelState& state) {
  LevelOutcome level;
  level.label = state.plan.label;
  level.accepted = state.accepted;
  level.attempts = state.attempts;
  if (state.registration) {
    level.rmse_m = state.registration->rmse_m;
    level.predicted_tre_m = nav::worst_m(state.predicted);
    level.registration_only = state.registration_only();
    level.points = state.registration->points;
    level.digitization_s = state.digitization_s;
    for (const nav::CheckPoint& point : state.check_points) {
      level.check_points_m.push_back(point.distance_m);
    }
  }
  if (state.newest && state.plan.model) {
    level.registered = RegisteredLevel{level.label,          {},
                                       state.plan.model,     state.plan.screws,
                                       state.newest->points, state.newest->registration};
  }
  if (level.registered && state.registration) {
    level.registered->check_points = state.check_points;
  }
  return level;
}

ScrewOutcome outcome_of_screw(const LevelState& state, std::size_t index) {
  const nav::ScrewPlan& plan = state.plan.screws[index];
  ScrewOutcome screw{plan.side, state.screws[index].done, {}, {}};
  screw.accepted_breach = plan.accepted_breach;
  if (state.screws[index].replanned()) {
    screw.planned_in_surgery = nav::difference_of(state.screws[index].preoperative, plan);
  }
  const auto cylinder = nav::cylinder_of(plan);
  screw.size = cylinder;
  if (cylinder && state.plan.model) {
    constexpr double kStep_m = 0.002;
    const double side_m = cylinder->length_m - nav::CylinderSurface::kFrom_m;
    screw.planned_profile_m.resize(1 + static_cast<std::size_t>(std::max(1.0, side_m / kStep_m)));
    if (!nav::clearance_profile(state.plan.model->surface(), *cylinder, screw.planned_profile_m)) {
      screw.planned_profile_m.clear();
    }
    const bool known = state.registration && state.registration->uncertainty;
    screw.planned = nav::screw_clearance(state.plan.model->surface(), *cylinder,
                                         known ? &*state.registration->uncertainty : nullptr);
  }
  screw.tracked = state.screws[index].clearance_at_depth;
  screw.trajectory = state.screws[index].executed;
  if (screw.trajectory && state.plan.model) {
    screw.driven = nav::cylinder_along(screw.trajectory->axis, plan, state.plan.model->surface());
  }
  screw.wire = state.screws[index].wire;
  screw.redone = state.screws[index].redone;
  return screw;
}

}  // namespace

bool ScrewOutcome::warned() const {
  const bool breach_bound = tracked && tracked->spread && tracked->spread->lower_95_m < 0.0;
  return breach_bound || !accepted_breach.empty() || (wire.measured && !wire.measured->within());
}

OperationResult outcome_of(std::span<const LevelState> levels, std::span<const RodState> rods,
                           LoopReport loop) {
  OperationResult result;
  result.completed = loop.done;
  for (const LevelState& state : levels) {
    LevelOutcome level = outcome_of(state);
    for (std::size_t s = 0; s < state.plan.screws.size(); ++s) {
      level.screws.push_back(outcome_of_screw(state, s));
      result.completed = result.completed && state.screws[s].done;
    }
    result.completed = result.completed && level.accepted;
    result.levels.push_back(std::move(level));
  }
  // "done" skips a side without a rod; one that was done before a resume has lost its places.
  result.completed =
      result.completed &&
      (!levels.empty() || std::any_of(rods.begin(), rods.end(), [](const RodState& rod) {
        return rod.done && (rod.rod || rod.map_moved);
      }));
  for (const RodState& rod : rods) {
    if (rod.heads.empty() && !rod_planned(levels, rod.side)) {
      continue;
    }
    RodOutcome outcome;
    outcome.side = rod.side;
    outcome.heads = rod.heads.size();
    outcome.took_s = rod.took_s;
    if (rod.rod) {
      outcome.length_m = rod.rod->length_m;
    }
    outcome.instructions = rod.instructions;
    outcome.no_instructions = rod.no_instructions;
    outcome.seat_by_pointer_m = rod.seat_by_pointer_m;
    result.rods.push_back(std::move(outcome));
  }
  result.loop = std::move(loop);
  return result;
}

void EndNote::happened(Timestamp /*time*/, Step /*from*/, Event /*event*/, Cell answer) {
  step_ = answer.next;
}

void EndNote::registered(Timestamp /*time*/, const LevelState& level,
                         const RegistrationOutcome& outcome) {
  refused_ = outcome.passed() ? ""
                              : "; last registration (" + level.plan.label +
                                    ") refused: " + refusal_text(outcome);
}

void EndNote::explain(OperationResult& result) const {
  if (result.completed) {
    return;
  }
  std::string unfinished;
  for (const LevelOutcome& level : result.levels) {
    const bool all_done = std::all_of(level.screws.begin(), level.screws.end(),
                                      [](const ScrewOutcome& screw) { return screw.done; });
    if (unfinished.empty() && !(level.accepted && all_done)) {
      unfinished = " of " + level.label;
    }
  }
  const bool no_rod = step_ == Step::kDone && result.levels.empty();
  result.why_not = no_rod ? "no rod: no side has two heads"
                          : "ended at " + std::string(name_of(step_)) + unfinished + refused_;
  if (!result.loop.ended) {
    result.why_not += "; " + result.loop.ended.error().message;
  }
}

std::optional<double> quantile(std::vector<double> values, double fraction) {
  if (values.empty()) {
    return std::nullopt;
  }
  std::sort(values.begin(), values.end());
  const auto rank =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

}  // namespace orthonav::engine
