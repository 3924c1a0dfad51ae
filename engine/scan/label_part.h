#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "engine/scan/label_convention.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// Calls `visit(index)` for each voxel of the label; `index` is a `std::array<int, 3>`.
template <class Visit>
void for_each_voxel(const Volume& labels, const LabelledLevel& level, const Visit& visit) {
  std::array<int, 3> at{};
  std::size_t voxel = 0;
  for (at[2] = 0; at[2] < labels.grid.size[2]; ++at[2]) {
    for (at[1] = 0; at[1] < labels.grid.size[1]; ++at[1]) {
      for (at[0] = 0; at[0] < labels.grid.size[0]; ++at[0], ++voxel) {
        if (labels.values[voxel * labels.layers + level.layer] == static_cast<float>(level.value)) {
          visit(at);
        }
      }
    }
  }
}

/// One vertebra extracted from a label map, with free voxels all around.
struct LabelPart {
  VolumeGrid grid;
  std::vector<std::uint8_t> inside;  ///< 1: bone
  std::size_t voxels = 0;            ///< of the label
  std::size_t dropped = 0;           ///< not connected with the rest
  std::size_t at_border = 0;         ///< of the label at the border of the scan, where it is cut
};

/// The largest connected part (by faces) of a label, with its cavities filled, since a mesh has a
/// single surface. `margin` free voxels are put around it. Refuses a label of fewer than 100
/// voxels.
Result<LabelPart> label_part(const Volume& labels, const LabelledLevel& level, int margin);

/// Numbers the connected parts of at least that density, from the largest on, as a label map with
/// values 1, 2, ...; parts smaller than `least_m3` are left out. Refuses a scan without any.
Result<Volume> dense_parts(const Volume& scan, double threshold_hu, double least_m3);

}  // namespace orthonav::engine
