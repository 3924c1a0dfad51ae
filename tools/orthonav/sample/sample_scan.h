#pragma once

#include <span>
#include <string>

#include "engine/case/case.h"
#include "engine/scan/volume.h"

namespace orthonav::tools {

/// A screw of metal, with a head that stands out of the bone, in the scan's frame.
struct MetalScrew {
  Vec3 entry_m;
  Vec3 tip_m;
  double radius_m = 0.0;
};

/// What a scanner makes of vertebrae: the scan in HU, and the labels of the convention `verse`.
struct SampleScan {
  engine::Volume ct;
  engine::Volume labels;
};

/// A computed scan in voxels of 0.8 mm: cancellous bone in a cortex of 1.2 mm in soft tissue, metal
/// where screws are, noise. Without streaks, neighbours and discs. Levels lie as in the spine;
/// their labels are L1 to L5.
[[nodiscard]] SampleScan scan_of(const engine::Case& subject, std::span<const MetalScrew> screws);

/// As NRRD of 16 bits.
[[nodiscard]] Status save_scan(const std::string& path, const engine::Volume& scan);

}  // namespace orthonav::tools
