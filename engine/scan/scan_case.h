#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "engine/case/case.h"
#include "engine/scan/label_surface.h"

namespace orthonav::engine {

/// A vertebra made of a label.
struct ScanLevel {
  std::string label;
  LabelSurface surface;
  std::size_t voxels = 0;   ///< of the label
  std::size_t dropped = 0;  ///< that did not hang together with the rest
  bool canal = true;        ///< a vertebral canal was found in it: else it is half a vertebra
};

struct ScanLevels {
  std::vector<ScanLevel> levels;      ///< from the head down
  std::vector<std::string> left_out;  ///< a line each: why a label became no level
};

/// Makes a mesh of each vertebra of a label map. `wanted` empty: of every one that is whole, T1 to
/// L6; those cut by the border of the scan are left out. Else of these alone: one that is not
/// there, cut, or no vertebra is refused. Refuses as `labelled_levels` does, and a map without a
/// whole vertebra.
Result<ScanLevels> scan_levels(const Volume& labels, const std::string& convention,
                               const std::vector<std::string>& wanted);

/// Makes a mesh of each connected part of at least 5 cm3 that is at least that dense, as "part1"
/// and so on. Parts that are no vertebra by their size are left out.
Result<ScanLevels> threshold_levels(const Volume& scan, double threshold_hu);

/// Refuses vertebrae (those of `labelled_levels`; what else a map holds counts for nothing) that do
/// not lie on the bone of the scan: more than a tenth of their voxels outside of it, or less than
/// 50 HU on average inside, which tells of mixed-up axes or of another patient. Refuses a scan with
/// several values a voxel, and as `labelled_levels` does.
Status check_on_bone(const Volume& labels, const std::string& convention, const Volume& scan);

/// The case: meshes as they lie in the scan, without screws.
[[nodiscard]] Case case_of(const ScanLevels& made, const std::string& name);

}  // namespace orthonav::engine
