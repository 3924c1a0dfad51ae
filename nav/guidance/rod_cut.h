#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "nav/guidance/rod.h"

namespace orthonav::nav {

/// Where the rod lies relative to the touched heads, and how far it overhangs.
struct RodSeating {
  /// From the touched place of a head to the middle of the rod in its tulip, along the screw,
  /// positive towards the bone. 6 mm is an estimate for a head touched on top: half the height of a
  /// tulip of 12 mm. Touched in the drive socket at the bottom of the tulip, the rod lies above the
  /// place, so that the distance is negative: the maker's drawing tells it.
  double head_to_seat_m = 0.006;
  /// Length wanted beyond the middle of the first and of the last seat.
  double overhang_m = 0.005;
  /// One per head, in their order, if they differ; empty: `head_to_seat_m` for all.
  std::vector<double> each_head_to_seat_m = {};
};

struct RodCut {
  std::vector<Vec3> seats_m;     ///< in the order of the template's heads
  double seated_length_m = 0.0;  ///< along the spline from the first to the last seat, to 1 µm
  double cut_length_m = 0.0;     ///< seated length plus the overhang at both ends
};

/// The least angle between the rod and `to_bone` of `to_bone_across`.
inline constexpr double kLeastOffRod_rad = 0.5235987755982988;  // 30°

/// The way from each head to its seat where no screw's own direction is known: `to_bone` (any
/// length but zero) without its part along the rod, because a tulip stands square to the rod in it.
/// Unit vectors, in the order of `rod.heads_m`. Refuses fewer than 2 heads, and a `to_bone` that is
/// not finite or less than 30° off the rod at a head.
Result<std::vector<Vec3>> to_bone_across(const RodTemplate& rod, Vec3 to_bone);

/// Limits of what `rod_cut` takes.
inline constexpr double kDeepestSeat_m = 0.03;
inline constexpr double kHighestSeat_m = 0.015;
inline constexpr double kLongestOverhang_m = 0.05;

/// The length to cut a rod to. The rod does not lie where the heads are touched, but at the seats:
/// each seat is its head plus `head_to_seat_m` along `to_bone`, the direction of that screw from
/// head to tip (any length but zero, in the order of `rod.heads_m`). In a lordosis the seats lie on
/// the outside of the curve, so their spline is longer than the heads': by the depth times the
/// angle of the curve, 4 mm for 6 mm and 40°. Refuses fewer than 2 heads, a number of directions or
/// seats that differs from that of heads, numbers that are not finite, distances beyond the limits
/// above, a negative overhang, and seats that coincide.
Result<RodCut> rod_cut(const RodTemplate& rod, std::span<const Vec3> to_bone,
                       const RodSeating& seating = {});

}  // namespace orthonav::nav
