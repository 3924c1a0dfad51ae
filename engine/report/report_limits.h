#pragma once

#include "base/angle.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/session/placed_wire.h"

namespace orthonav::engine {

/// The limits for "on target" in reports, independent of the operation's own limits, so that
/// reports can be compared: the angle at which the triangle turns red, and the distance at which a
/// placed wire is questioned.
inline constexpr double kOnTarget_rad = GradeLimits{}.poor_rad;
inline constexpr double kOnTarget_m = PlacedWireRules{}.entry_limit_m;

}  // namespace orthonav::engine
