#pragma once

#include "engine/scan/volume.h"
#include "nav/geometry/mesh.h"

namespace orthonav::test {

/// A closed surface as a label map: a voxel has 1 where its middle lies inside. Four free
/// voxels all around.
inline engine::Volume voxelised(const nav::TriangleMesh& mesh, Vec3 spacing_m) {
  constexpr int kMargin = 4;
  const nav::SurfaceIndex bone(mesh);
  const nav::Bounds box = nav::bounds_of(mesh);
  engine::Volume out;
  out.grid.spacing_m = spacing_m;
  for (int axis = 0; axis < 3; ++axis) {
    out.grid.origin_m[axis] = box.low[axis] - (kMargin - 0.3) * spacing_m[axis];
    out.grid.size[static_cast<std::size_t>(axis)] =
        static_cast<int>((box.high[axis] - box.low[axis]) / spacing_m[axis]) + 2 * kMargin;
  }
  out.values.reserve(out.grid.voxels());
  for (int k = 0; k < out.grid.size[2]; ++k) {
    for (int j = 0; j < out.grid.size[1]; ++j) {
      for (int i = 0; i < out.grid.size[0]; ++i) {
        const Vec3 place_m = out.grid.place_m({double(i), double(j), double(k)});
        out.values.push_back(bone.contains(place_m) ? 1.0F : 0.0F);
      }
    }
  }
  return out;
}

}  // namespace orthonav::test
