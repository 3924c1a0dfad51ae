#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/side.h"
#include "base/transform.h"

namespace orthonav::nav {

using orthonav::Side;

/// A planned pedicle screw: from the entry point on the bone to the target inside.
struct ScrewPlan {
  Side side = Side::kLeft;
  Point<Vertebra> entry;
  Point<Vertebra> target;
  double radius_m = 0.0;  ///< 0: not stated
  /// The reason why the screw is allowed to break through the cortex; empty: it is not allowed to.
  std::string accepted_breach = {};
};

/// The largest slope of the bone's surface at a screw's entry, relative to the screw's axis; beyond
/// it the drill slips: 60°.
inline constexpr double kSteepestEntry_rad = 1.047;

/// An axis in space: `point` on it, unit `direction` into the bone.
template <class Frame>
struct Axis {
  Point<Frame> point;
  Vec3 direction;
};

/// What guides the surgeon to one screw: the triangle between entry point, current and planned
/// trajectory, the angle between the two in space (both Liebmann et al. 2019), and depth.
///
/// B and C are where the tool's axis and the planned axis leave the sphere of radius `reach` about
/// A. With a parallel tool, B is about as far from C as the tool is from the planned axis. The
/// depth of the tip changes nothing. The angle at A equals `angle_rad` only if the tool's axis runs
/// through the entry. B coinciding with C does not by itself mean that the tool is aligned with the
/// plan: its axis may cross the planned one in C.
struct ScrewGuidance {
  double angle_rad = 0.0;  ///< between the directions of tool axis and planned trajectory, [0, pi]
  Point<World> tip;        ///< of the tool
  Vec3 tool_outward;       ///< unit, along the tool's axis from the tip up the shaft
  Point<World> a;          ///< entry point
  /// On the tool's axis, |AB| = reach; if the axis passes the entry at a greater distance, its
  /// point nearest to the entry.
  Point<World> b;
  Point<World> c;               ///< on the planned axis outside the bone, |AC| = reach
  double tip_to_entry_m = 0.0;  ///< distance of the tip from the entry point
  double tip_off_axis_m = 0.0;  ///< distance of the tip from the planned axis
  double depth_m = 0.0;         ///< of the tip past the entry along the planned axis; < 0: before
  double to_target_m = 0.0;     ///< of the tip from the target along the planned axis; < 0: past it
  /// Offsets from the planned axis, perpendicular to it: of the tip, and of the point `reach` up
  /// the tool's axis.
  Vec3 tip_offset_m;
  Vec3 top_offset_m;
};

inline constexpr double kTriangleReach_m = 0.080;

/// `tool_axis_in_world` points from the tip back along the shaft and may have any length but zero;
/// `tip_in_world` is its tip. The plan's entry and target must differ (plan files are checked for
/// that).
[[nodiscard]] ScrewGuidance guide(const Transform<World, Vertebra>& world_from_vertebra,
                                  const ScrewPlan& plan, Point<World> tip_in_world,
                                  Vec3 tool_axis_in_world);

}  // namespace orthonav::nav
