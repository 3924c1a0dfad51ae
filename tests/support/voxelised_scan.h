#pragma once

#include "engine/scan/volume.h"
#include "tests/support/voxelised_body.h"

namespace orthonav::test {

struct ScannerSettings {
  Vec3 spacing_m{0.0006, 0.0006, 0.0006};
  double slice_m = 0.0;        ///< thickness of a slice; 0: the same as their distance
  double blur_m = 0.00045;     ///< SD of the point spread, in every direction
  double noise_hu = 25.0;      ///< SD
  double streaks = 1.0;        ///< 0: none
  double highest_hu = 3071.0;  ///< of 12 bits; 0: not clipped
  std::uint64_t seed = 1;
};

/// Scans it: point spread, slices of some thickness, streaks between metal (from parallel
/// projections with beam hardening and starved rays, filtered and projected back slice by slice),
/// noise, whole numbers, clipped. The voxels start a random part of a voxel off the body's grid.
[[nodiscard]] engine::Volume scanned(const FineBody& body, const ScannerSettings& settings);

}  // namespace orthonav::test
