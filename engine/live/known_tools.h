#pragma once

#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// The tools in use, as far as the headset knows them: from a room's planning file or a recording's
/// tools.json; otherwise the built-in ones. An Error if it measures tools itself without describing
/// them, since their tips would be unknown.
Result<std::vector<nav::ToolGeometry>> tools_known_to(Headset& headset);

}  // namespace orthonav::engine
