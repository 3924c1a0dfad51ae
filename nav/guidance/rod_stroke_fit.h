#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "nav/guidance/rod_stroke.h"

namespace orthonav::nav {

/// The place on the rod's axis nearest to a point.
struct StrokeFoot {
  double distance_m = std::numeric_limits<double>::infinity();
  double along_m = 0.0;  ///< of the axis, from its first end
  Vec3 off_m;            ///< from there to the point, in the rod's frame
};

/// A rod to be fitted to the points of a stroke, and where the search begins.
struct RodStrokeTask {
  std::span<const RodArc> arcs;  ///< the last one is fitted too; none: the rod is straight
  double length_m = 0.0;
  double radius_m = 0.0;
  std::span<const Vec3> points_m;
  Mat3 points_from_rod = Mat3::identity();
  Vec3 rod_in_points_m;
};

struct RodStrokeFit {
  MeasuredBend rod;              ///< its `arc` is of no meaning for a straight rod
  std::vector<StrokeFoot> feet;  ///< of the points
};

/// Where the rod lies, and angle and roll of its last bend, with standard errors that grow with
/// what neighbouring points have in common.
Result<RodStrokeFit> fit_rod_stroke(const RodStrokeTask& task, const RodStrokeRules& rules);

}  // namespace orthonav::nav
