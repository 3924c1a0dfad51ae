#pragma once

#include <cstddef>

#include "base/tracked.h"
#include "base/transform.h"

namespace orthonav {

/// Where a tool was at the moment of a frame, measured by the device itself, as an optical tracker
/// does, and not by us in images.
struct MeasuredTool {
  std::size_t tool = 0;  ///< index into StereoCamera::measured_tools()
  Transform<Rig, Marker> rig_from_marker;
  /// How far that may be off as the device, or whoever set it up, states it; in Rig.
  PoseCovariance covariance{};
};

}  // namespace orthonav
