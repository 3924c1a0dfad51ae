#pragma once

#include <optional>

#include "base/tracked.h"
#include "hal/api/devices.h"
#include "nav/tracking/online_calibration.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::engine {

/// A tag's corners in the image of each camera; nothing where it was not found.
struct StereoCorners {
  std::optional<nav::TagCorners> left_px;
  std::optional<nav::TagCorners> right_px;
};

/// The pose that explains a tag's corners best.
struct CornerPose {
  Transform<Rig, Marker> rig_from_marker;
  PoseCovariance covariance{};  ///< in the rig
  /// If both cameras saw it: the equations for the calibration from the corners.
  std::optional<nav::CalibrationEquations> calibration;
};

/// Gauss-Newton on the unit planes of the described cameras, starting from a pose that is right to
/// a few pixels. Nothing if a corner has no direction or a motion is undetermined. `sd_px`: of a
/// corner.
[[nodiscard]] std::optional<CornerPose> corner_pose(const StereoCorners& seen,
                                                    const Transform<Rig, Marker>& start,
                                                    const StereoCalibration& cameras, double size_m,
                                                    double sd_px);

}  // namespace orthonav::engine
