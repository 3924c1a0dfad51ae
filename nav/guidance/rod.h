#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::nav {

/// One bend of the rod: at the arc length from the first head, by the angle between the chords
/// before and after.
struct RodBend {
  double arc_length_m = 0.0;
  double angle_rad = 0.0;
  Vec3 position_m;
};

struct RodTemplate {
  std::vector<Vec3> heads_m;  ///< in the order along the rod
  std::vector<Vec3> path_m;   ///< the spline, sampled every millimetre
  double length_m = 0.0;      ///< of the spline, to 1 µm
  double diameter_m = 0.0055;
  std::vector<RodBend> bends;  ///< at the inner heads
};

/// Diameters a rod may have.
inline constexpr double kThinnestRod_m = 0.001;
inline constexpr double kThickestRod_m = 0.015;

/// A rod through the screw heads: ordered along their principal axis, joined by a centripetal
/// Catmull-Rom spline (as in Liebmann et al. 2019). Refuses heads that a spinal rod can't join:
/// fewer than 2, non-finite ones, heads closer than 5 mm, neighbours along the rod farther apart
/// than 150 mm, bends of more than 60° (so also points that double back), more than 600 mm of
/// length, and diameters outside the limits above. Messages number the heads as they were given.
Result<RodTemplate> rod_template(std::span<const Vec3> heads_m, double diameter_m = 0.0055);

}  // namespace orthonav::nav
