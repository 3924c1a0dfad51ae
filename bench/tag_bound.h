#pragma once

#include <array>

#include "bench/tag_stage.h"

namespace orthonav::bench {

/// The smallest variance of a tool's pose, as `Sequence::bound` says it.
[[nodiscard]] std::array<double, 36> cramer_rao_bound(const TagKind& kind,
                                                      const StereoCalibration& calibration,
                                                      const Transform<Rig, Marker>& pose,
                                                      std::size_t tool);

}  // namespace orthonav::bench
