#include <Eigen/Dense>

#include "nav/tracking/symmetric_covariance.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {

void add_head(ToolState& state, const StereoFrame& frame) {
  using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  TrackedPose& pose = state.world_from_marker;
  if (!frame.world_from_rig || !frame.head_covariance || pose.status == PoseStatus::kLost) {
    return;
  }
  const Vec3 arm_m = pose.value.translation() - frame.world_from_rig->translation();
  Matrix6 carried = Matrix6::Identity();
  carried.topRightCorner<3, 3>() << 0, arm_m.z, -arm_m.y, -arm_m.z, 0, arm_m.x, arm_m.y, -arm_m.x,
      0;
  const Eigen::Map<const Matrix6> head(frame.head_covariance->data());
  const Eigen::Map<const Matrix6> of_tag(pose.covariance.data());
  pose.covariance = symmetrized(Matrix6(of_tag + carried * head * carried.transpose()));
}

}  // namespace orthonav::nav
