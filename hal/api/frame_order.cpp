#include "hal/api/frame_order.h"

#include <cmath>

namespace orthonav {

std::string in_seconds(Timestamp t) { return std::to_string(seconds(t.time_since_epoch())) + " s"; }

bool is_rigid(const Transform<World, Rig>& pose) {
  // A pose that a device publishes is a rotation to rounding: `checked` makes it one.
  constexpr double kMaxPoseDeviation = Transform<World, Rig>::kExact;
  return pose.translation().is_finite() && pose.rotation().determinant() > 0.0 &&
         orthonormality_error(pose.rotation()) <= kMaxPoseDeviation;
}

bool is_sound(const PoseCovariance& covariance) {
  bool sound = true;
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    sound = sound && std::isfinite(covariance[i]) && (i % 7 != 0 || covariance[i] >= 0.0);
  }
  return sound;
}

Status FrameOrder::check_order(std::string_view what, const FrameHeader& frame) const {
  const std::string name(what);
  if (last_.time && frame.time <= *last_.time) {
    return Error{name + ": time " + in_seconds(frame.time) + " does not come after " +
                 in_seconds(*last_.time)};
  }
  if (frame.sequence <= last_.sequence) {
    return Error{name + ": sequence number " + std::to_string(frame.sequence) +
                 " does not come after " + std::to_string(last_.sequence)};
  }
  if (frame.map_epoch < last_.map_epoch) {
    return Error{name + ": map epoch " + std::to_string(frame.map_epoch) + " comes after " +
                 std::to_string(last_.map_epoch)};
  }
  return {};
}

Status FrameOrder::check_pose(std::string_view what, const FrameHeader& frame) {
  if (!frame.world_from_rig || is_rigid(*frame.world_from_rig)) {
    return {};
  }
  return Error{std::string(what) + ": head pose at " + in_seconds(frame.time) +
               " is not a rigid motion"};
}

}  // namespace orthonav
