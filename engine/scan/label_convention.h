#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// The voxels of a vertebra: those of a layer with a value.
struct LabelledLevel {
  std::string label;  ///< "L4"
  std::size_t layer = 0;
  int value = 0;
};

/// The names that `labelled_levels` accepts: "verse", "totalsegmentator", "totalsegmentator-v1".
[[nodiscard]] const std::vector<std::string>& label_conventions();

/// The vertebrae that a label map holds, from the head down (C1-C7, T1-T13, L1-L6, S1), with at
/// least one voxel each. A segmentation of 3D Slicer (fields `SegmentN_Name`) contains names, in
/// which levels are searched for; for any other map a convention is needed:
///
///     verse                L1...L5 = 20...24 (also TPTBox)
///     totalsegmentator     L1...L5 = 31...27 (task `total` of version 2)
///     totalsegmentator-v1  L1...L5 = 22...18
///
/// Refuses a map without a convention or with an unknown one, with the list of them, values that
/// are not labels, a level that two segments claim, and a map without a vertebra of that
/// convention.
Result<std::vector<LabelledLevel>> labelled_levels(const Volume& labels,
                                                   const std::string& convention);

}  // namespace orthonav::engine
