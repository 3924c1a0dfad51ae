#pragma once

#include <span>
#include <vector>

#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

struct BorderVoxel {
  Vec3 place_m;
  double hu = 0.0;
};

/// The voxels about the border of a shaft and its ends, some thousands at most, without those that
/// belong to another shaft or its head.
[[nodiscard]] std::vector<BorderVoxel> border_voxels(const ScanField& scan, const Shaft& shaft,
                                                     std::span<const Shaft> others);

}  // namespace orthonav::engine
