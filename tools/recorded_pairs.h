#pragma once

#include <functional>
#include <string>

#include "hal/replay/replay_headset.h"

namespace orthonav::tools {

/// Calls with every pair of a recording, with progress on standard error; returns the first
/// failure.
Status for_each_pair(replay::ReplayHeadset& recording,
                     const std::function<void(const StereoFrame&)>& use);

/// The best method of tracking that this version has.
[[nodiscard]] std::string default_method();

}  // namespace orthonav::tools
