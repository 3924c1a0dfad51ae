#pragma once

#include <functional>

#include "base/vec.h"
#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// Negative inside, positive outside, metres. It need not be an exact distance, but a value of v
/// must mean that the surface is no nearer than about v / 2.
using ImplicitFunction = std::function<double(Vec3)>;

/// The zero surface inside a box as a closed manifold mesh, outward-oriented: dual contouring on a
/// grid of `step_m` with a vertex for each sheet in a cell (Nielson 2004, "Dual marching cubes"),
/// then a few rounds of smoothing and stepping back onto the surface, so that triangles are well
/// shaped and vertices lie on it within a micron. The box must hold the whole surface.
[[nodiscard]] TriangleMesh surface_of(const ImplicitFunction& inside_negative, Vec3 low_m,
                                      Vec3 high_m, double step_m);

}  // namespace orthonav::nav
