#pragma once

#include <array>
#include <optional>

#include "base/vec.h"
#include "hal/api/devices.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/photometric_view.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// The two poses of a square tag that one camera can't distinguish by its corners: they differ in
/// the direction in which the tag is tilted relative to the line of sight (Collins & Bartoli 2014,
/// "Infinitesimal plane-based pose estimation", on the ambiguity). Each starts at the homography of
/// the corners on the unit plane (Zhang 2000, section 3.1), which is several percent off in
/// distance for noisy corners of a small tag, and is fitted to the corners by least squares; the
/// better fit comes first. The corners are in the order of `MarkerCorners`. Nothing if they do not
/// form a square in front of the camera.
[[nodiscard]] std::optional<std::array<CameraFromTag, 2>> planar_poses(
    const std::array<Vec2, 4>& unit_plane, double size_m);

/// The same in the rig, for a tag whose corners only one camera sees.
[[nodiscard]] std::optional<std::array<Transform<Rig, Tag>, 2>> poses_by_one(
    const StereoCalibration& calibration, const MarkerCorners& seen, bool right, double size_m);

}  // namespace orthonav::nav
