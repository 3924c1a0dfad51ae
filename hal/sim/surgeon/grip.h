#pragma once

#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// How a tool is held: by its tip and axis, turned about the axis so that its tag faces the viewer
/// as far as the axis allows, and further by `roll_rad`.
struct Grip {
  Point<Room> tip;
  Vec3 axis{0, 1, 0};  ///< unit, from the tip back along the shaft
  double roll_rad = 0.0;
};

[[nodiscard]] Transform<Room, Marker> held(const RoomTool& tool, const Grip& grip,
                                           Vec3 towards_viewer);
/// Where the hand is: on the shaft between tip and tag, so that it leaves the tag free.
[[nodiscard]] Point<Room> hand_on(const RoomTool& tool, const Grip& grip);
/// The component of a vector perpendicular to a unit axis.
[[nodiscard]] inline Vec3 across_axis(Vec3 v, Vec3 axis) { return v - v.dot(axis) * axis; }
/// Any unit vector perpendicular to a given one.
[[nodiscard]] Vec3 perpendicular_to(Vec3 unit);
/// `from` turned towards `to` by this fraction of the angle between them; unit vectors.
[[nodiscard]] Vec3 rotated_towards(Vec3 from, Vec3 to, double fraction);

}  // namespace orthonav::sim
