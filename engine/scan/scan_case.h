#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "engine/case/case.h"
#include "engine/scan/label_surface.h"

namespace orthonav::engine {

/// A vertebra made from a label.
struct ScanLevel {
  std::string label;
  LabelSurface surface;
  std::size_t voxels = 0;   ///< of the label
  std::size_t dropped = 0;  ///< not connected with the rest
  bool canal = true;        ///< a vertebral canal was found in it; otherwise it is half a vertebra
};

struct ScanLevels {
  std::vector<ScanLevel> levels;      ///< from the head down
  std::vector<std::string> left_out;  ///< one line each: why a label did not become a level
  std::string unusual;                ///< what is unusual about their distances; empty: nothing
};

/// Makes a mesh of each vertebra of a label map. `wanted` empty: every complete one, T1 to L6;
/// those cut by the border of the scan are left out. Otherwise only these: one that is missing,
/// cut, or not a vertebra is refused. Refuses as `labelled_levels` does, and a map without a
/// complete vertebra. `unusual`: as in `check_places`.
Result<ScanLevels> scan_levels(const Volume& labels, const std::string& convention,
                               const std::vector<std::string>& wanted, bool unusual = false);

/// Makes a mesh of each connected part of at least 5 cm3 and at least that density, as "part1" and
/// so on. Parts that do not have the size of a vertebra are left out.
Result<ScanLevels> threshold_levels(const Volume& scan, double threshold_hu);

/// Refuses vertebrae (only those of `labelled_levels` count) that do not lie on the bone of the
/// scan: more than a tenth of their voxels outside the scan, or less than 50 HU on average inside,
/// which indicates mixed-up axes or another patient. Refuses a scan with several values per voxel,
/// and as `labelled_levels` does.
Status check_on_bone(const Volume& labels, const std::string& convention, const Volume& scan);

/// The case: meshes where they are in the scan, without screws.
[[nodiscard]] Case case_of(const ScanLevels& made, const std::string& name);

}  // namespace orthonav::engine
