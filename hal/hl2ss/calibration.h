#pragma once

#include <array>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "hal/api/camera_model.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// The calibration that a front camera reports. `A` is the camera's frame.
template <class A>
struct CameraCalibration {
  CameraModel camera;
  Transform<A, Rig> camera_from_rig;
};

/// From the answer in mode 2: tables of unit-plane x and y at integer pixel coordinates, which are
/// the pixels' top-left corners and are converted to pixel centres here, and camera_from_rig for
/// row vectors. The undistorted image's maps and focal lengths after them are not needed. Entries
/// (0, 0) are pixels without a direction, unless their neighbours look straight ahead too. Refuses
/// a wrong size, an invalid camera (`CameraModel::from_lookup`) and an invalid rigid motion.
Result<CameraCalibration<LeftCamera>> read_left_calibration(Bytes answer);
Result<CameraCalibration<RightCamera>> read_right_calibration(Bytes answer);

/// A server's answer for a camera of 640×480; maps and focal lengths are zero.
[[nodiscard]] std::vector<std::uint8_t> calibration_bytes(const CameraModel& camera,
                                                          const std::array<double, 16>& row_major);

/// Removes the directions along the edges from such an answer, as on a headset whose mapping failed
/// there.
void unmap_edges(std::vector<std::uint8_t>& answer, int edge_px);

}  // namespace orthonav::hl2ss
