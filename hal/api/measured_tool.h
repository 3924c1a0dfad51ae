#pragma once

#include <cstddef>

#include "base/tracked.h"
#include "base/transform.h"

namespace orthonav {

/// Where a tool was at the time of a frame, measured by the device itself, such as an optical
/// tracker, not found in images.
struct MeasuredTool {
  std::size_t tool = 0;  ///< index into StereoCamera::measured_tools()
  Transform<Rig, Marker> rig_from_marker;
  /// Covariance as stated by the device or its configuration; in Rig.
  PoseCovariance covariance{};
};

}  // namespace orthonav
