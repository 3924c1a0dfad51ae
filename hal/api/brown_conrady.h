#pragma once

#include "hal/api/camera_model.h"

namespace orthonav {

/// Inverse of `BrownConrady::distort` by Newton's method, starting from the undistorted pixel; NaN
/// where the polynomial does not reach the pixel on the branch that contains the centre.
[[nodiscard]] Vec2 undistorted(const BrownConrady& p, Vec2 pixel_px);

/// Refuses numbers that are not finite and focal lengths that are not positive.
[[nodiscard]] Status checked_parameters(const BrownConrady& p);

}  // namespace orthonav
