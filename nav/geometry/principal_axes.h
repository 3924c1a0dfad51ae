#pragma once

#include <array>
#include <span>

#include "base/vec.h"

namespace orthonav::nav {

/// The centre of a cloud and the right-handed directions of its greatest, middle and least spread.
struct PrincipalAxes {
  Vec3 centre_m;
  std::array<Vec3, 3> axes;
  std::array<double, 3> deviation_m{};  ///< standard deviation along each axis
};

/// `weights` empty: all equal. Needs at least one finite point and a positive sum of weights. The
/// signs of the axes are arbitrary but repeatable.
[[nodiscard]] PrincipalAxes principal_axes(std::span<const Vec3> points_m,
                                           std::span<const double> weights = {});

}  // namespace orthonav::nav
