#pragma once

#include <string>
#include <vector>

#include "tests/support/tag_scene.h"

namespace orthonav::test {

/// Records, in our recorder's layout, the images of these tags from two cameras like a HoloLens
/// 2's: a pair for each entry, at the given rate. The tags carry noise of 2 grey levels.
void record(const std::string& folder, const StereoCalibration& calibration,
            const std::vector<std::vector<PlacedTag>>& pairs, int rate_hz = 30);
/// The same with cameras that do not lie as the device reports.
void record(const std::string& folder, const StereoCalibration& really,
            const StereoCalibration& device, const std::vector<std::vector<PlacedTag>>& pairs,
            int rate_hz = 30);

}  // namespace orthonav::test
