#pragma once

#include <vector>

#include "engine/scan/label_part.h"

namespace orthonav::engine {

/// Approximately the signed distance to the surface of a label, metres: negative inside, smooth,
/// and with the sign of the label at each voxel's middle. See `label_surface` for the method.
class LabelField {
 public:
  explicit LabelField(const LabelPart& part);
  /// The value at a place in the scan's frame; outside the part's grid, that at its border.
  [[nodiscard]] double value_m(Vec3 place_m) const;

 private:
  VolumeGrid grid_;
  std::vector<float> values_m_;
};

}  // namespace orthonav::engine
