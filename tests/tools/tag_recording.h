#pragma once

#include <string>
#include <vector>

#include "tests/support/tag_scene.h"

namespace orthonav::test {

/// Records, in our recorder's layout, what two cameras like a HoloLens 2's see of these tags: a
/// pair for each entry, so many a second. The images carry noise of 2 grey levels.
void record(const std::string& folder, const StereoCalibration& calibration,
            const std::vector<std::vector<PlacedTag>>& pairs, int rate_hz = 30);
/// The same of cameras that do not lie as the device says.
void record(const std::string& folder, const StereoCalibration& really,
            const StereoCalibration& device, const std::vector<std::vector<PlacedTag>>& pairs,
            int rate_hz = 30);

}  // namespace orthonav::test
