#include "hal/api/frame_order.h"

namespace orthonav {

std::string in_seconds(Timestamp t) { return std::to_string(seconds(t.time_since_epoch())) + " s"; }

bool is_rigid(const Transform<World, Rig>& pose) {
  // A pose that a device publishes is a rotation to rounding: `checked` makes it one.
  constexpr double kMaxPoseDeviation = Transform<World, Rig>::kExact;
  return pose.translation().is_finite() && pose.rotation().determinant() > 0.0 &&
         orthonormality_error(pose.rotation()) <= kMaxPoseDeviation;
}

Status FrameOrder::check_order(std::string_view what, Timestamp time, std::int64_t sequence,
                               std::int64_t map_epoch) const {
  const std::string name(what);
  if (last_.time && time <= *last_.time) {
    return Error{name + ": time " + in_seconds(time) + " does not come after " +
                 in_seconds(*last_.time)};
  }
  if (sequence <= last_.sequence) {
    return Error{name + ": sequence number " + std::to_string(sequence) + " does not come after " +
                 std::to_string(last_.sequence)};
  }
  if (map_epoch < last_.map_epoch) {
    return Error{name + ": map epoch " + std::to_string(map_epoch) + " comes after " +
                 std::to_string(last_.map_epoch)};
  }
  return {};
}

Status FrameOrder::check_pose(std::string_view what, Timestamp time,
                              const std::optional<Transform<World, Rig>>& pose) {
  if (!pose || is_rigid(*pose)) {
    return {};
  }
  return Error{std::string(what) + ": head pose at " + in_seconds(time) + " is not a rigid motion"};
}

}  // namespace orthonav
