#pragma once

#include <filesystem>

#include "hal/api/devices.h"

namespace orthonav::replay {

/// Look-up tables and extrinsics of both front cameras. Prefers our recorder's look-up tables in
/// double precision where they lie beside the others.
Result<StereoCalibration> read_calibration(const std::filesystem::path& folder);

/// Writes them, double precision too; refuses cameras that the layout cannot hold (not 640×480).
Status write_calibration(const std::filesystem::path& folder, const StereoCalibration& calibration);

}  // namespace orthonav::replay
