#pragma once

#include <cstddef>
#include <span>

#include "base/angle.h"
#include "base/result.h"
#include "base/vec.h"
#include "nav/guidance/rod_shape.h"

namespace orthonav::nav {

/// What is known before a stroke, and what it must hold. The SDs of a bend hold only what the
/// stroke does not tell: the roll of the first bend, of a bend that is very small. Estimates.
struct RodStrokeRules {
  double angle_sd_rad = 1.5 * kRadiansPerDegree;
  double roll_sd_rad = 3.5 * kRadiansPerDegree;
  double tip_sd_m = 0.001;  ///< of one point, at least
  /// Points that scatter more about the rod than this are not on it.
  double most_rms_m = 0.003;
  std::size_t fewest_points = 30;
  double beyond_bend_m = 0.01;  ///< the stroke reaches at least so far past both ends of the bend
};

/// The last bend as it came out.
struct MeasuredBend {
  RodArc arc;
  double angle_se_rad = 0.0;  ///< standard error
  /// The first bend's roll against the drawn line can't be felt: then it is `roll_sd_rad`.
  double roll_se_rad = 0.0;
  double rms_m = 0.0;  ///< of the points' distances from the rod's surface
  /// The rod's frame (rod_shape.h) in that of the points, while it lies there.
  Mat3 points_from_rod = Mat3::identity();
  Vec3 rod_in_points_m;
};

/// The last of `arcs` (its place as instructed, angle and roll to begin from; those before it as
/// they are known) from the places where the pointer touched the rod, in passes from the first end
/// to the last, in that order, in any frame in which the rod was at rest. Three sides of the rod
/// are wanted: about a single line the axis may lie anywhere, and the standard errors say so. The
/// tip runs on the surface: what is fitted is the distance of every point from the axis less half
/// the diameter, so it need not be known on which sides it ran. The standard errors grow with what
/// neighbouring points have in common. Refuses points that are not finite, too few, farther off the
/// rod than `most_rms_m`, or on one side of the bend only.
Result<MeasuredBend> measured_bend(std::span<const RodArc> arcs, double length_m, double diameter_m,
                                   std::span<const Vec3> stroked_m,
                                   const RodStrokeRules& rules = {});

}  // namespace orthonav::nav
