#pragma once

#include "hal/api/devices.h"

namespace orthonav::sim {

/// Round-number parameters of the two front cameras in the ranges that several real HoloLens 2
/// units report: focal length 355-366 px, principal point within about 20 px of the centre, k1 ≈
/// -0.04, baseline 98.3-99.7 mm. Raw images are 640×480 and lie on their side, the right one turned
/// by 180° relative to the left; Rig is x right, y up, z backward, at the left camera.
[[nodiscard]] BrownConrady hololens2_left();
[[nodiscard]] BrownConrady hololens2_right();
/// Made at the first call, since its look-up tables take a tenth of a second.
[[nodiscard]] const StereoCalibration& hololens2_calibration();

}  // namespace orthonav::sim
