#pragma once

#include <optional>

#include "hal/api/devices.h"

namespace orthonav::nav {

/// The distance of a point in the right image from the epipolar line of a point in the left one, in
/// pixels of the right image, signed (positive on the side that the line's normal points to). Empty
/// if a pixel has no direction.
[[nodiscard]] std::optional<double> across_epipolar_px(
    const CameraModel& left, const CameraModel& right,
    const Transform<RightCamera, LeftCamera>& right_from_left, Vec2 left_px, Vec2 right_px);

}  // namespace orthonav::nav
