#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "engine/case/case.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// A vertebra whose surface somebody else made.
struct MeshLevel {
  CaseLevel level;
  double volume_m3 = 0.0;
  bool canal = true;  ///< a vertebral canal was found in it; otherwise it is half a vertebra
};

/// Levels of a case from surfaces of one scan, as `load_mesh` reads them (metres, LPS), sorted
/// from the head down. Refuses names that are not those of a vertebra (C1-C7, T1-T13, L1-L6, S1)
/// or that repeat; what `check_places` refuses; and axes in which the vertebra has its canal only
/// once it is turned by 180° about the patient's long axis: RAS that was taken for LPS, or the
/// other way round. `unusual`: as in `check_places`.
Result<std::vector<MeshLevel>> mesh_levels(std::vector<CaseLevel> meshes,
                                           std::string* unusual = nullptr);

/// Refuses vertebrae that do not lie on the bone of the scan, as `BoneSamples` does, by places
/// inside them every 2 mm.
Status check_on_bone(const std::vector<MeshLevel>& levels, const Volume& scan);

}  // namespace orthonav::engine
