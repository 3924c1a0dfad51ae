#pragma once

#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// The part of a vertebra (axes LPS, closed, outward-oriented, metres) that a pointer coming from
/// behind can touch: faces with a free line of sight to the back, within 75 degrees to either side
/// and 40 degrees up and down, and behind the front wall of the canal. So the body's wall goes even
/// where it can be seen between the laminae, which soft tissue covers. Small islands are dropped.
TriangleMesh reachable_from_behind(const TriangleMesh& mesh, const SurfaceIndex& surface);

}  // namespace orthonav::nav
