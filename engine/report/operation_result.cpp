#include "engine/report/operation_result.h"

#include <algorithm>
#include <cmath>

#include "engine/session/text/wording.h"

namespace orthonav::engine {

OperationResult result_of(OperationState state, LoopReport loop) {
  OperationResult result;
  result.completed = loop.done;
  for (const LevelState& level : state.levels) {
    result.completed = result.completed && level.accepted && level.finished();
    result.truth.levels.emplace_back().screws.resize(level.plan.screws.size());
  }
  // "done" skips a side without a rod; one that was done before a resume has lost its places.
  result.completed = result.completed && (!state.levels.empty() ||
                                          std::ranges::any_of(state.rods, [](const RodState& rod) {
                                            return rod.done && (rod.rod || rod.map_moved);
                                          }));
  result.state = std::move(state);
  result.loop = std::move(loop);
  return result;
}

std::optional<RegisteredLevel> registered_level(const LevelState& level) {
  if (!level.newest || !level.plan.model) {
    return std::nullopt;
  }
  RegisteredLevel registered{level.plan.label,     {},
                             level.plan.model,     level.plan.screws,
                             level.newest->points, level.newest->registration};
  if (level.registration) {
    registered.check_points = level.check_points;
  }
  return registered;
}

std::optional<nav::ScrewCylinder> driven_screw(const LevelState& level, std::size_t screw,
                                               const ScrewTruth& truth) {
  const auto& tracked = level.screws[screw].executed;
  if (truth.known || !tracked || !level.plan.model) {
    return truth.driven;
  }
  return nav::cylinder_along(tracked->axis, level.plan.screws[screw], level.plan.model->surface());
}

bool has_rod(const OperationState& state, const RodState& rod) {
  return !rod.heads.empty() || rod_planned(state.levels, rod.side);
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
  for (const LevelState& level : result.state.levels) {
    if (unfinished.empty() && !(level.accepted && level.finished())) {
      unfinished = " of " + level.plan.label;
    }
  }
  const bool no_rod = step_ == Step::kDone && result.state.levels.empty();
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
