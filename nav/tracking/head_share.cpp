#include "nav/tracking/tag_pose.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

void add_head(ToolState& state, const StereoFrame& frame) {
  TrackedPose& pose = state.world_from_marker;
  if (!frame.world_from_rig || !frame.head_covariance || pose.status == PoseStatus::kLost) {
    return;
  }
  const Vec3 lever_arm_m = pose.value.translation() - frame.world_from_rig->translation();
  pose.covariance = plus_carried(pose.covariance, *frame.head_covariance, lever_arm_m);
}

}  // namespace orthonav::nav
