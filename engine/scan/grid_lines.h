#pragma once

#include <array>
#include <cstddef>

#include "engine/scan/volume.h"

namespace orthonav::engine {

/// Calls `line(first, stride, count)` for every line of voxels along an axis: its first voxel, the
/// step to the next one, and how many there are.
template <class Line>
void for_each_line(const VolumeGrid& grid, std::size_t axis, const Line& line) {
  const std::array<std::size_t, 3> stride = {grid.at(1, 0, 0), grid.at(0, 1, 0), grid.at(0, 0, 1)};
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (int b = 0; b < grid.size[v]; ++b) {
    for (int a = 0; a < grid.size[u]; ++a) {
      line(static_cast<std::size_t>(a) * stride[u] + static_cast<std::size_t>(b) * stride[v],
           stride[axis], static_cast<std::size_t>(grid.size[axis]));
    }
  }
}

}  // namespace orthonav::engine
