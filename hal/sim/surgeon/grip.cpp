#include "hal/sim/surgeon/grip.h"

#include <cmath>

namespace orthonav::sim {
namespace {

/// Where the shaft is held, as a fraction of the way from tip to tag.
constexpr double kHandOnShaft = 0.38;

/// The component of `v` perpendicular to `unit`, as a unit vector; any such vector if it is zero.
Vec3 across(Vec3 v, Vec3 unit) {
  const Vec3 rest = v - v.dot(unit) * unit;
  return rest.norm() > 1e-6 ? rest.normalized() : perpendicular_to(unit);
}

}  // namespace

Vec3 perpendicular_to(Vec3 unit) {
  const Vec3 helper = std::abs(unit.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  return unit.cross(helper).normalized();
}

Vec3 rotated_towards(Vec3 from, Vec3 to, double fraction) {
  const Vec3 axis = from.cross(to);
  const double angle = angle_between_rad(from, to);
  if (axis.norm() < 1e-12) {
    return fraction < 0.5 ? from : to;
  }
  return (rotation_from_vector((fraction * angle) * axis.normalized()) * from).normalized();
}

Transform<Room, Marker> held(const RoomTool& tool, const Grip& grip, Vec3 towards_viewer) {
  const Vec3 axis_in_marker = tool.axis_in_marker.normalized();
  const Vec3 face_in_marker = across({0, 0, 1}, axis_in_marker);
  const Vec3 face =
      rotation_from_vector(grip.roll_rad * grip.axis) * across(towards_viewer, grip.axis);
  const Mat3 from_marker =
      Mat3::from_columns(face_in_marker, axis_in_marker, face_in_marker.cross(axis_in_marker));
  const Mat3 to_room = Mat3::from_columns(face, grip.axis, face.cross(grip.axis));
  const Mat3 rotation = to_room * from_marker.transposed();
  return {rotation, grip.tip.v - rotation * tool.tip_in_marker.v};
}

Point<Room> hand_on(const RoomTool& tool, const Grip& grip) {
  const double length = -tool.tip_in_marker.v.dot(tool.axis_in_marker);
  return grip.tip + (kHandOnShaft * length) * grip.axis;
}

}  // namespace orthonav::sim
