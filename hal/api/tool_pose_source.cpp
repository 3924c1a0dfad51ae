#include "hal/api/tool_pose_source.h"

namespace orthonav {
namespace {

constexpr const char* kWhat = "tool poses";

Status check_tools(const ToolPoses& poses, std::span<const std::string> names) {
  if (poses.tools.size() != names.size()) {
    return Error{std::string(kWhat) + ": of " + std::to_string(poses.tools.size()) +
                 " tools, names " + std::to_string(names.size())};
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& tool = poses.tools[i];
    const char* problem = nullptr;
    if (tool.status == PoseStatus::kLost) {
      continue;
    }
    if (tool.status != PoseStatus::kMeasured) {
      problem = " is predicted, must be measured or lost";
    } else if (tool.time != poses.time) {
      problem = " is of another time";
    } else if (!is_rigid({tool.value.rotation(), tool.value.translation()})) {
      problem = " is not a rigid motion";
    } else if (!is_sound(tool.covariance)) {
      problem = ": covariance is not finite, or has a negative variance";
    }
    if (problem != nullptr) {
      return Error{std::string(kWhat) + ": pose of " + names[i] + " at " + in_seconds(poses.time) +
                   problem};
    }
  }
  return {};
}

}  // namespace

void ToolPoses::clear() {
  sequence = -1;
  world_from_rig.reset();
  tools.clear();
}

Result<Next> ToolPoseSource::next(ToolPoses& poses) {
  return order_.next(
      kWhat, poses, [&] { return do_next(poses); }, [&] { return check_tools(poses, names()); });
}

}  // namespace orthonav
