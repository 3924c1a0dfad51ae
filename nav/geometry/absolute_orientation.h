#pragma once

#include <span>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::nav {

struct RigidFit {
  Mat3 rotation;
  Vec3 translation_m;
  double rmse_m = 0.0;  ///< the FRE
};

/// The least-squares rotation and translation that take `from` onto `to`, by unit quaternions (Horn
/// 1987, "Closed-form solution of absolute orientation using unit quaternions"). Refuses fewer than
/// 3 points, different counts, non-finite and collinear points. Never a reflection.
Result<RigidFit> absolute_orientation(std::span<const Vec3> from_m, std::span<const Vec3> to_m);

}  // namespace orthonav::nav
