#pragma once

#include <cstdint>
#include <vector>

#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// The faces of a vertebra (axes LPS, closed, outward-oriented, metres) that a pointer coming from
/// behind can touch: faces with a free line of sight to the back, within 75 degrees to either side
/// and 40 degrees up and down, and behind the front wall of the canal. This excludes the body's
/// wall even where it can be seen between the laminae, since soft tissue covers it. Small islands
/// are dropped. Ascending.
std::vector<std::uint32_t> faces_reachable_from_behind(const TriangleMesh& mesh,
                                                       const SurfaceIndex& surface);

/// Whether the face can be seen from behind, even if it lies in front of the canal or on an island.
bool is_visible_from_behind(const TriangleMesh& mesh, const SurfaceIndex& surface,
                            std::uint32_t face);

}  // namespace orthonav::nav
