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

/// A mesh with fewer triangles.
struct Coarser {
  MeshData mesh;
  float error_m = 0;  ///< how far the surface moved, mean over triangles
};

/// The mesh with about this many triangles or, where its shape forbids that, more. Where two
/// vertices lie at one place they stay apart, as at the rim of a cap, unless `joined`: then a
/// surface of separate triangles gets fewer as well.
[[nodiscard]] Coarser coarser(const MeshData& mesh, std::size_t triangles, bool joined);

}  // namespace orthonav::render
