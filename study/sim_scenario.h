#pragma once

#include <string_view>
#include <vector>

#include "engine/case/case.h"
#include "engine/case/operation.h"
#include "engine/session/known_errors.h"
#include "engine/session/session_options.h"
#include "hal/sim/room/room.h"
#include "hal/sim/sim_headset.h"
#include "nav/tracking/tool.h"

namespace orthonav::engine {

/// The simulated operating room of a case: it contains every level, and those of the operation are
/// operated in its order. Where rods alone are bent, every planned screw stands in it, exactly as
/// planned. The tools are made exactly as in `tools`.
[[nodiscard]] sim::RoomDescription room_of(const Case& source, const Operation& operation,
                                           const std::vector<nav::ToolGeometry>& tools);

/// Where its surgeons stroke: with `paper` in the pattern that the publication's were trained in,
/// else the laminae.
[[nodiscard]] sim::Exposure strokes_of(std::string_view method);

/// Refuses rods alone where no screw stands in the room.
[[nodiscard]] Status check_standing_screws(const Operation& operation,
                                           const sim::RoomDescription& room);

/// What all strokes in this room have in common: the SDs that follow from those from which it
/// draws, not the drawn values, times `told_sd_factor`. `sizes_estimated`: sizes of tags are
/// estimated in use.
[[nodiscard]] KnownErrors errors_in(const sim::SimOptions& room, bool sizes_estimated = true);
/// Tells an operation in this room how well the guide is known, and how far drills go astray, both
/// times `told_sd_factor`.
void tell_instruments(const sim::SimOptions& room, SessionOptions& session);

}  // namespace orthonav::engine
