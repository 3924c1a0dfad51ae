#include "engine/session/operation_in_work.h"

#include <utility>

namespace orthonav::engine {
namespace {

LevelState state_of(OperatedLevel plan) {
  LevelState state;
  state.screw_done.assign(plan.screws.size(), false);
  state.clearance_at_depth.resize(plan.screws.size());
  state.executed.resize(plan.screws.size());
  state.wires.resize(plan.screws.size());
  state.redone.resize(plan.screws.size());
  state.preoperative = plan.screws;
  state.earlier_plans.resize(plan.screws.size());
  state.plan = std::move(plan);
  return state;
}

/// Movement of the first screw's entry: `RegistrationFigures::followed_m`.
std::optional<double> followed_m(const LevelState& level, const nav::Anchor* anchor) {
  if (anchor == nullptr || !level.registered_on_map || level.plan.screws.empty()) {
    return std::nullopt;
  }
  const Point<World> entry =
      level.registration->world_from_vertebra * level.plan.screws.front().entry;
  return (anchor->world_from_anchored * entry - *level.registered_on_map * entry).norm();
}

}  // namespace

OperationInWork::OperationInWork(Operation operation, WatchedTools watched, Method with,
                                 const SessionOptions& session_options)
    : options(session_options),
      method(std::move(with)),
      tools(std::move(watched)),
      messages(session_options.message_for, session_options.heard_for) {
  for (OperatedLevel& plan : operation.levels) {
    levels.push_back(state_of(std::move(plan)));
  }
}

void add_tip(Touch& touch, const WatchedTools& tools, std::size_t tool) {
  const nav::TrackedPose& pose = tools.watch(tool).newest();
  if (pose.status == PoseStatus::kMeasured) {
    touch.add(pose.value * tools.geometry(tool).tip_in_marker);
  } else {
    touch.lose();
  }
}

TouchedPlace take_place(Touch& touch, const OperationInWork& work, Timestamp time) {
  return touch.take_place(work.tools.pointer_tip(time, work.options.stale_after),
                          work.options.max_touch_spread_m);
}

RegistrationFigures figures_of(const OperationInWork& work) {
  const LevelState& level = work.level();
  return {.rmse_m = level.registration->rmse_m,
          .expected_m = nav::worst_m(level.predicted),
          .registration_only = level.registration_only(),
          .followed_m = followed_m(level, work.tools.tracker().anchor())};
}

}  // namespace orthonav::engine
