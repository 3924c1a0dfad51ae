#pragma once

#include <string>

#include "tools/orthonav/depth/depth_output.h"

namespace orthonav::tools {

inline constexpr int kMaxLiveFrames = 100000;

/// Whether it is a headset's URI and not a folder.
[[nodiscard]] bool names_headset(const std::string& source);

/// `depth` of a connected headset: takes frames as they arrive. Returns the exit code.
int depth_of_headset(const DepthArguments& arguments);

}  // namespace orthonav::tools
