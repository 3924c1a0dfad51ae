#pragma once

#include <vector>

#include "engine/case/case.h"
#include "engine/case/operation.h"
#include "hal/sim/room.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// The simulated operating room of a case: every level lies in it, and those of the operation are
/// operated, in its order. The tools are made exactly as `tools` says.
[[nodiscard]] sim::RoomDescription room_of(const Case& source, const Operation& operation,
                                           const std::vector<nav::ToolGeometry>& tools);

}  // namespace orthonav::engine
