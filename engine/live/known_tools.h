#pragma once

#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// What a headset itself knows of the tools in use: a room's planning file, a recording's
/// tools.json; the built-in ones where it tells nothing.
Result<std::vector<nav::ToolGeometry>> tools_known_to(const Headset& headset);

}  // namespace orthonav::engine
