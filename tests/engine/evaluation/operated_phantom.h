#pragma once

#include "engine/phantom/phantom.h"
#include "tests/support/operated_spine.h"
#include "tests/support/voxelised_scan.h"

namespace orthonav::test {

/// A coarse scan of an operation, quick to compute: 1 mm slices of voxels of 0.8 mm.
inline engine::Volume quick_scan(const OperatedSpine& spine, double streaks = 1.0,
                                 double slices_m = 0.001) {
  BodySettings body;
  body.step_m = 0.0004;
  ScannerSettings scanner;
  scanner.spacing_m = {0.0008, 0.0008, slices_m};
  scanner.streaks = streaks;
  return scanned(fine_body(spine.bones, spine.metal, body), scanner);
}

}  // namespace orthonav::test
