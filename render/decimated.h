#pragma once

#include <cstddef>
#include <memory>

#include "render/scene.h"

namespace orthonav::render {

/// The mesh reduced to about `most_triangles` at most, with its shape preserved as well as
/// possible: edges are collapsed by quadric error, or, where holes and seams forbid that, vertices
/// are merged on a grid. Vertices keep their positions and normals; those that no triangle needs
/// any more are dropped. Indices must be in range. A mesh that is small enough is returned
/// unchanged.
[[nodiscard]] MeshData decimated(const MeshData& mesh, std::size_t most_triangles);

/// How finely a surface is drawn.
struct MeshDetail {
  /// In the mesh's own unit: a surface of many triangles is drawn from nearby with as few as move
  /// it by no more than this, mean over triangles (single points may be four times as far off).
  float error = 2e-5f;
  std::size_t enough_triangles = 14'000;  ///< with fewer, simplifying does not pay
  std::size_t most_triangles = 250'000;   ///< regardless of the error
};

/// The mesh with its levels of detail, to be shared by scenes. It takes some tens of milliseconds
/// for a vertebra: for when a model is loaded, not for a frame. The renderer makes no levels. A
/// mesh that is not valid is returned as it is, for the renderer to say what is wrong.
[[nodiscard]] std::shared_ptr<const MeshData> prepared(MeshData mesh,
                                                       const MeshDetail& detail = {});

}  // namespace orthonav::render
