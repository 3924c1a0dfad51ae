#pragma once

#include <vector>

#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// Metal that belongs to no shaft: heads, plates, crumbs.
struct OtherMetal {
  Point<Scan> centre;
  double volume_m3 = 0.0;
};

struct MetalPieces {
  std::vector<Shaft> shafts;  ///< to about a voxel; `covariance` is not filled yet
  std::vector<OtherMetal> others;
};

/// Straight shafts among the voxels of metal: the line through two of them that runs through the
/// longest unbroken metal (RANSAC, Fischler and Bolles 1981; its seed is fixed), then the middles
/// of the cross sections about it, as far as these have the same size; a thicker part at one end is
/// a head. A shaft found is removed, with its head, and the next one is searched for. Shafts are at
/// least 12 mm long, at least 2.2 times as long as thick, and 1 to 10 mm thick. The remaining metal
/// is grouped by proximity; groups of less than 20 mm³ are dropped.
[[nodiscard]] MetalPieces straight_metal(const ScanField& scan);

}  // namespace orthonav::engine
