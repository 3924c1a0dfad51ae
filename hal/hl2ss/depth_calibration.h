#pragma once

#include "base/result.h"
#include "hal/api/depth_camera.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// A depth camera's calibration as it reports it.
struct DepthDescription {
  DepthCalibration camera;
  double units_per_m = 0.0;  ///< of the numbers in its raw pictures
};

/// The size of its answer in bytes.
[[nodiscard]] std::size_t depth_calibration_bytes(DepthStream stream);

/// From the answer in mode 2: tables of directions as for the front cameras, sensor_from_rig for
/// row vectors, raw units per metre, and for AHaT the alias in raw units. The maps and focal
/// lengths of the undistorted image after them are skipped. Refuses a wrong size, an invalid rigid
/// motion, impossible scales, and a camera without any pixel that has a direction.
Result<DepthDescription> read_depth_calibration(DepthStream stream, Bytes answer);

/// Millimetres for each possible number in a raw picture; 0: nothing was measured.
[[nodiscard]] std::vector<std::uint16_t> millimetres_of(const DepthDescription& camera);

}  // namespace orthonav::hl2ss
