#pragma once

#include <cstddef>

#include "render/scene.h"

namespace orthonav::render {

/// The mesh with about `most_triangles` at most, its shape kept as well as that allows: edges
/// collapsed by quadric error, or, where holes and seams forbid that, vertices merged on a grid.
/// Vertices keep their places and normals; those that no triangle needs any more are left out.
/// Indices must be in range. A mesh that is small enough comes back as it is.
[[nodiscard]] MeshData decimated(const MeshData& mesh, std::size_t most_triangles);

/// The same with as few triangles as move the surface by no more than about `error_m`, but never
/// fewer than about `enough_triangles`.
[[nodiscard]] MeshData simplified(const MeshData& mesh, std::size_t enough_triangles,
                                  float error_m);

}  // namespace orthonav::render
