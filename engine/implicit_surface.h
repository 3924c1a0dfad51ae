#pragma once

#include <functional>

#include "hal/api/vec.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// Negative inside, positive outside, metres; need not be an exact distance.
using ImplicitFunction = std::function<double(Vec3)>;

/// The zero surface inside a box as a closed mesh, outward-oriented: surface nets (Gibson 1998,
/// "Constrained elastic surface nets") on a grid of `step_m`, then a few rounds of evening out and
/// stepping back onto the surface, so that triangles are well shaped and vertices lie on it within
/// microns. The box must hold the whole surface. Parts thinner than two steps may come out
/// non-manifold; `nav::checked_vertebra` tells.
[[nodiscard]] nav::TriangleMesh surface_of(const ImplicitFunction& inside_negative, Vec3 low_m,
                                           Vec3 high_m, double step_m);

}  // namespace orthonav::engine
