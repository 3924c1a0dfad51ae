#pragma once

#include <array>
#include <vector>

#include "hal/api/camera_model.h"
#include "hal/api/result.h"
#include "hal/api/transform.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// What one front camera says of itself. `A` is the camera's frame.
template <class A>
struct CameraCalibration {
  CameraModel camera;
  Transform<A, Rig> camera_from_rig;
};

/// From the answer in mode 2: tables of unit-plane x and y at integer pixels, where (0, 0) is the
/// centre of the top-left pixel, and camera_from_rig for row vectors. The undistorted image's maps
/// and focal lengths behind them are not needed. Refuses a wrong size, what is no camera
/// (`CameraModel::from_lookup`) and what is no rigid motion.
Result<CameraCalibration<LeftCamera>> read_left_calibration(Bytes answer);
Result<CameraCalibration<RightCamera>> read_right_calibration(Bytes answer);

/// The answer that a server gives: maps and focal lengths are zero.
[[nodiscard]] std::vector<std::uint8_t> calibration_bytes(const CameraModel& camera,
                                                          const std::array<double, 16>& row_major);

}  // namespace orthonav::hl2ss
