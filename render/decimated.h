#pragma once

#include <cstddef>

#include "render/scene.h"

namespace orthonav::render {

/// The mesh reduced to about `most_triangles` at most, with its shape preserved as well as
/// possible: edges are collapsed by quadric error, or, where holes and seams forbid that, vertices
/// are merged on a grid. Vertices keep their positions and normals; those that no triangle needs
/// any more are dropped. Indices must be in range. A mesh that is small enough is returned
/// unchanged.
[[nodiscard]] MeshData decimated(const MeshData& mesh, std::size_t most_triangles);

/// The same, with as few triangles as possible while the surface moves by no more than about
/// `error_m`, but never fewer than about `enough_triangles`.
[[nodiscard]] MeshData simplified(const MeshData& mesh, std::size_t enough_triangles,
                                  float error_m);

}  // namespace orthonav::render
