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
  double radius_m = 0.0;
};

/// An axis in space: `point` on it, unit `direction` into the bone.
template <class Frame>
struct Axis {
  Point<Frame> point;
  Vec3 direction;
};

/// What guides the surgeon to one screw: the paper's triangle A-B-C and 3-D angle, and depth.
struct ScrewGuidance {
  double angle_rad = 0.0;       ///< between tool axis and planned trajectory, in [0, pi]
  Point<World> tip;             ///< of the tool
  Point<World> a;               ///< entry point
  Point<World> b;               ///< on the tool's direction, |AB| = reach
  Point<World> c;               ///< on the planned axis outside the bone, |AC| = reach
  double tip_to_entry_m = 0.0;  ///< distance of the tip from the entry point
  double tip_off_axis_m = 0.0;  ///< distance of the tip from the planned axis
  double depth_m = 0.0;         ///< of the tip past the entry along the planned axis; < 0: before
  double to_target_m = 0.0;     ///< of the tip from the target along the planned axis; < 0: past it
  /// Perpendicular to the planned axis, from that axis: of the tip, and of the point `reach` up the
  /// tool's axis.
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
