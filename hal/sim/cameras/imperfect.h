#pragma once

#include <vector>

#include "hal/api/devices.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room/noise.h"
#include "hal/sim/room/room.h"

namespace orthonav::sim {

/// The cameras as they really are, when the device's own calibration is slightly wrong by the error
/// model: focal length and principal point of each, and the right camera's pose relative to the
/// left one.
Result<StereoCalibration> perturbed(const StereoCalibration& reported,
                                    const ErrorModel& error_model, const Random& random);

/// The tools as a planning file describes them: tip and axis slightly off by the error model.
[[nodiscard]] std::vector<RoomTool> described(const std::vector<RoomTool>& tools,
                                              const ErrorModel& error_model, const Random& random);

}  // namespace orthonav::sim
