#pragma once

#include <vector>

#include "engine/scan/label_part.h"

namespace orthonav::engine {

/// About the signed distance to the surface of a label, metres: negative inside, smooth, and at
/// each voxel's middle on the side that the label says. See `label_surface` for the method.
class LabelField {
 public:
  explicit LabelField(const LabelPart& part);
  /// At a place in the frame of the scan; outside of the part's grid as at its border.
  [[nodiscard]] double value_m(Vec3 place_m) const;

 private:
  VolumeGrid grid_;
  std::vector<float> values_m_;
};

}  // namespace orthonav::engine
