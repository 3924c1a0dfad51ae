#pragma once

#include <functional>
#include <span>
#include <vector>

#include "nav/geometry/mesh.h"

namespace orthonav::test {

/// A box-like bone of 70 x 20 x 50 mm whose back (+y) is `height_m(x, z)` high. Closed, outward-
/// oriented; as symmetric as its height is.
nav::TriangleMesh slab_bone(const std::function<double(double, double)>& height_m);

/// A back with an oblique crest and two unequal knobs: no motion maps it onto itself.
double crooked_back(double x, double z);
/// A back that is the same after half a turn about y, so two poses fit.
double twofold_back(double x, double z);

/// Places on the surface itself, as strokes from left to right and back pass over them: seen
/// straight from behind, about 0.7 mm apart.
std::vector<Vec3> strokes_over(const nav::SurfaceIndex& surface, std::size_t lanes);

}  // namespace orthonav::test
