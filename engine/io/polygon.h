#pragma once

#include <cstdint>
#include <span>

#include "base/result.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// Appends a face of a file, cut into triangles from one of its corners, to the mesh. The corners
/// are indices of the mesh's vertices from `first_vertex` on. Points and lines are left out.
/// Refuses faces with missing vertices or more than 64 corners, and those that can't be fanned into
/// triangles from any corner.
Status add_face(std::span<const std::uint32_t> corners, std::size_t first_vertex,
                nav::TriangleMesh& mesh);

}  // namespace orthonav::engine
