#include "nav/guidance/screw.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// From the nearest point of an axis to where it leaves the sphere of `reach`; zero outside.
double half_chord_m(Vec3 axis_from_centre) {
  return std::sqrt(
      std::max(0.0, kTriangleReach_m * kTriangleReach_m - axis_from_centre.squared_norm()));
}

}  // namespace

ScrewGuidance guide(const Transform<World, Vertebra>& world_from_vertebra, const ScrewPlan& plan,
                    Point<World> tip_in_world, Vec3 tool_axis_in_world) {
  const Point<World> entry = world_from_vertebra * plan.entry;
  const Point<World> target = world_from_vertebra * plan.target;
  const Vec3 inward = (target - entry).normalized();
  const Vec3 tool_outward = tool_axis_in_world.normalized();
  const Vec3 tip_from_entry = tip_in_world - entry;
  // From the entry to the nearest point of the tool's axis.
  const Vec3 axis_from_entry = tip_from_entry - tool_outward * tip_from_entry.dot(tool_outward);
  ScrewGuidance g;
  // The tool's axis points out of the patient, so the plan's outward side is compared with it.
  g.angle_rad = angle_between_rad(tool_outward, -inward);
  g.tip = tip_in_world;
  g.tool_outward = tool_outward;
  g.a = entry;
  g.b = entry + axis_from_entry + half_chord_m(axis_from_entry) * tool_outward;
  g.c = entry - kTriangleReach_m * inward;
  g.tip_to_entry_m = tip_from_entry.norm();
  const auto off_axis = [&](Vec3 from_entry) {
    return from_entry - inward * from_entry.dot(inward);
  };
  g.tip_offset_m = off_axis(tip_from_entry);
  g.top_offset_m = off_axis(tip_from_entry + kTriangleReach_m * tool_outward);
  g.tip_off_axis_m = tip_from_entry.cross(inward).norm();
  g.depth_m = tip_from_entry.dot(inward);
  g.to_target_m = (target - entry).norm() - g.depth_m;
  return g;
}

}  // namespace orthonav::nav
