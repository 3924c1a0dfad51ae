#include "engine/session/tool_watch.h"

namespace orthonav::engine {

void ToolWatch::update(const nav::TrackedPose& world_from_marker) {
  newest_ = world_from_marker;
  if (newest_.status != PoseStatus::kMeasured) {
    return;
  }
  older_ = newer_;
  newer_ = newest_;
}

std::optional<Timestamp> ToolWatch::last_measured() const {
  if (newer_.status != PoseStatus::kMeasured) {
    return std::nullopt;
  }
  return newer_.time;
}

bool ToolWatch::fresh(Timestamp now, Duration within) const {
  return newer_.status == PoseStatus::kMeasured && newer_.age(now) <= within;
}

nav::TrackedPose ToolWatch::at(Timestamp time, Duration coast) const {
  return nav::predicted(older_, newer_, time, coast);
}

}  // namespace orthonav::engine
