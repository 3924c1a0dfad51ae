#pragma once

#include "base/result.h"
#include "hal/api/depth_camera.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// What a depth camera says of itself.
struct DepthDescription {
  DepthCalibration camera;
  double units_per_m = 0.0;  ///< of the numbers in its raw pictures
};

/// How many bytes it answers with.
[[nodiscard]] std::size_t depth_calibration_bytes(DepthStream stream);

/// From the answer in mode 2: tables of directions as for the front cameras, sensor_from_rig for
/// row vectors, raw units per metre, and for AHaT the alias in raw units. The maps and focal
/// lengths of the undistorted image behind them are skipped. Refuses a wrong size, what is no rigid
/// motion, scales that no sensor has, and a camera of which no pixel has a direction.
Result<DepthDescription> read_depth_calibration(DepthStream stream, Bytes answer);

/// Millimetres for each number that a raw picture may hold; 0: nothing was measured.
[[nodiscard]] std::vector<std::uint16_t> millimetres_of(const DepthDescription& camera);

}  // namespace orthonav::hl2ss
