#include "engine/session/session_state.h"

#include <utility>

namespace orthonav::engine {

SessionState::SessionState(Operation operation, WatchedTools watched, Method with,
                           const SessionOptions& session_options)
    : options(session_options),
      method(std::move(with)),
      tools(std::move(watched)),
      messages(session_options.message_for, session_options.heard_for) {
  for (OperatedLevel& plan : operation.levels) {
    state.levels.push_back(planned_level(std::move(plan)));
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

TouchedPlace take_place(SessionState& work, Timestamp time) {
  return work.touches.pointer.take_place(work.tools.pointer_tip(time, work.options.stale_after),
                                         work.options.max_touch_spread_m);
}

}  // namespace orthonav::engine
