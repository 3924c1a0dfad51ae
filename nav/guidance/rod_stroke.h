#pragma once

#include <cstddef>
#include <span>

#include "base/angle.h"
#include "base/result.h"
#include "base/vec.h"
#include "nav/guidance/rod_shape.h"

namespace orthonav::nav {

/// What is known before a stroke, and what the stroke must satisfy. The SDs of a bend matter only
/// for what the stroke does not determine: the roll of the first bend, and of a very small bend.
/// Estimates.
struct RodStrokeRules {
  double angle_sd_rad = 1.5 * kRadiansPerDegree;
  double roll_sd_rad = 3.5 * kRadiansPerDegree;
  double tip_sd_m = 0.001;  ///< of one point, at least
  /// Points that scatter about the rod by more than this are not on it.
  double most_rms_m = 0.003;
  /// The same for a straight rod, where a bend of 25° in its middle scatters more.
  double most_rms_straight_m = 0.002;
  std::size_t fewest_points = 30;
  double beyond_bend_m = 0.01;   ///< the stroke must reach at least this far past both ends of the
                                 ///< bend
  double short_of_end_m = 0.01;  ///< the stroke may be shorter than the rod by this
};

/// The last bend as measured.
struct MeasuredBend {
  RodArc arc;
  double angle_se_rad = 0.0;  ///< standard error
  /// The pointer can't find the drawn line: for the first bend this is `roll_sd_rad`.
  double roll_se_rad = 0.0;
  double rms_m = 0.0;  ///< of the points' distances from the rod's surface
  /// Length of the mean direction from the axis to the points: 0 all around it, 1 on one side
  /// alone.
  double one_sided = 0.0;
  /// The rod's frame (rod_shape.h) in that of the points, while it lies there.
  Mat3 points_from_rod = Mat3::identity();
  Vec3 rod_in_points_m;
};

/// Measures the last of `arcs` (its place is as instructed, its angle and roll are starting values;
/// the arcs before it are known) from the points where the pointer touched the rod, in passes from
/// the first end to the last, in that order, in any frame in which the rod was at rest. The passes
/// should run along three sides of the rod: a single pass does not determine the axis, and the
/// standard errors then say so. The tip runs on the surface: the fit minimizes each point's
/// distance from the axis minus half the diameter, so the sides need not be known. The standard
/// errors include the correlation of neighbouring points. Refuses points that are not finite, too
/// few, farther off the rod than `most_rms_m`, or on only one side of the bend, and a stroke that
/// is shorter than the rod.
Result<MeasuredBend> measured_bend(std::span<const RodArc> arcs, double length_m, double diameter_m,
                                   std::span<const Vec3> stroked_m,
                                   const RodStrokeRules& rules = {});

/// Where a straight rod lies, as stroked.
struct LaidRod {
  /// The rod's frame (rod_shape.h) in that of the points; its roll about the axis is arbitrary,
  /// since the drawn line can't be felt.
  Mat3 points_from_rod = Mat3::identity();
  Vec3 rod_in_points_m;
  double length_m = 0.0;   ///< of the stroke, at least that of the rod: it may not be cut yet
  double rms_m = 0.0;      ///< of the points' distances from the rod's surface
  double one_sided = 0.0;  ///< as above
};

/// Finds where a rod lies that is not bent yet, to be cut to `length_m`, by the same fit. Along its
/// axis only the stroke's ends tell where it lies. Refuses what `measured_bend` refuses.
Result<LaidRod> laid_rod(double length_m, double diameter_m, std::span<const Vec3> stroked_m,
                         const RodStrokeRules& rules = {});

}  // namespace orthonav::nav
