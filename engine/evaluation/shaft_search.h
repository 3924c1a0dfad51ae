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
/// of the cross sections about it, as far as those are of one size; what is thicker at one end is a
/// head. A shaft that was found is taken out, with its head, and the next one is sought. Shafts are
/// 12 mm long or more, at least 2.2 times as long as thick, and 1 to 10 mm thick. What is left is
/// grouped by nearness; groups of less than 20 mm³ are dropped.
[[nodiscard]] MetalPieces straight_metal(const ScanField& scan);

}  // namespace orthonav::engine
