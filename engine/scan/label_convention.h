#pragma once

#include <optional>
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

/// The vertebrae of a label map, and what it holds beside them.
struct LabelledLevels {
  std::vector<LabelledLevel> levels;  ///< from the head down
  std::vector<std::string> left_out;  ///< labels or segments that are no vertebrae, a line in all
};

/// The vertebra ("L4") that a segment's name states, in the usual spellings: `L4`, `vertebrae_L4`,
/// `L4 vertebra`, `lumbar vertebra 4`, `Th12`, `LWK 4`, `Lendenwirbel 4`. Nothing for a name with
/// any other word (disc, nerve, left, screw), with two levels, or without one.
[[nodiscard]] std::optional<std::string> vertebra_named(const std::string& name);

/// The names that `labelled_levels` accepts: "verse", "totalsegmentator", "totalsegmentator-v1".
[[nodiscard]] const std::vector<std::string>& label_conventions();

/// The vertebrae that a label map holds (C1-C7, T1-T13, L1-L6, S1), with at least one voxel each. A
/// segmentation of 3D Slicer (fields `SegmentN_Name`) names them (`vertebra_named`); a segment
/// without a `_Layer` is in the layer of its own index. For any other map a convention is needed:
///
///     verse                L1...L5 = 20...24 (also TPTBox)
///     totalsegmentator     L1...L5 = 31...27 (task `total` of version 2)
///     totalsegmentator-v1  L1...L5 = 22...18
///
/// Refuses a map without a convention or with an unknown one, with the list of them; values that
/// are not labels or not of that convention; a T13 without a neighbour; a level that two segments
/// claim, a segment whose layer is open, and a map without a vertebra.
Result<LabelledLevels> labelled_levels(const Volume& labels, const std::string& convention);

}  // namespace orthonav::engine
