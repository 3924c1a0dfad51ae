#pragma once

#include <filesystem>
#include <string>

#include "hal/api/depth_camera.h"
#include "hal/api/devices.h"

namespace orthonav::replay {

/// Look-up tables and extrinsics of both front cameras. Prefers our recorder's look-up tables in
/// double precision, if present.
Result<StereoCalibration> read_calibration(const std::filesystem::path& folder);

/// Writes them, including those in double precision; refuses cameras that the layout can't hold
/// (other than 640×480).
Status write_calibration(const std::filesystem::path& folder, const StereoCalibration& calibration);

/// The same for a depth camera; its images determine the size of its table.
Result<DepthCalibration> read_depth_calibration(const std::filesystem::path& folder,
                                                const std::string& sensor, DepthStream stream,
                                                int width_px, int height_px);
Status write_depth_calibration(const std::filesystem::path& folder, const std::string& sensor,
                               const DepthCalibration& calibration);

}  // namespace orthonav::replay
