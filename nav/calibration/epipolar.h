#pragma once

#include <optional>

#include "hal/api/devices.h"

namespace orthonav::nav {

/// How far a place in the right image lies from the epipolar line of a place in the left one, in
/// pixels of the right image, signed (positive on the side to which the line's normal shows).
/// Nothing where a pixel has no direction.
[[nodiscard]] std::optional<double> across_epipolar_px(
    const CameraModel& left, const CameraModel& right,
    const Transform<RightCamera, LeftCamera>& right_from_left, Vec2 left_px, Vec2 right_px);

}  // namespace orthonav::nav
