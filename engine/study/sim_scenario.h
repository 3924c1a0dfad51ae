#pragma once

#include <vector>

#include "engine/case/case.h"
#include "engine/case/operation.h"
#include "hal/open/open.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// The simulated operating room of a case: every level lies there, those of the operation are
/// operated, in its order. The tools are made exactly as `tools` says.
[[nodiscard]] sim::RoomDescription room_of(const Case& source, const Operation& operation,
                                           const std::vector<nav::ToolGeometry>& tools);

/// What a planning file of that room says of its tools: slightly off, as calibrations are.
[[nodiscard]] std::vector<nav::ToolGeometry> described_tools(const sim::SimHeadset& headset);

/// What a headset itself knows of the tools in use: a room's planning file, a recording's
/// tools.json; else the built-in ones.
Result<std::vector<nav::ToolGeometry>> tools_known_to(const Headset& headset);

}  // namespace orthonav::engine
