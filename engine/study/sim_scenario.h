#pragma once

#include <vector>

#include "engine/case/case.h"
#include "engine/case/operation.h"
#include "engine/session/session_options.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// The simulated operating room of a case: it contains every level, and those of the operation are
/// operated in its order. The tools are made exactly as in `tools`.
[[nodiscard]] sim::RoomDescription room_of(const Case& source, const Operation& operation,
                                           const std::vector<nav::ToolGeometry>& tools);

/// Tells an operation in this room what all strokes have in common, how well the guide is known,
/// and how far drills go astray: the SDs that follow from those from which the room draws, not the
/// drawn values. `sizes_estimated`: sizes of tags are estimated in use.
void tell_common_errors(const sim::ErrorModel& room, bool sizes_estimated, SessionOptions& session);

}  // namespace orthonav::engine
