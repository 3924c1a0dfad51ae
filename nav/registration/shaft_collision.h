#pragma once

#include <span>

#include "nav/registration/registration.h"

namespace orthonav::nav {

/// Fraction of the points at which, in this pose, the pointer's shaft would have gone through bone:
/// the space that the pointer occupied must be free. `shafts_in_world` are unit vectors from the
/// tip back, one per point; a point without one (zero) does not count. 0 without points. Samples a
/// hundred or so points.
[[nodiscard]] double shaft_collision_fraction(const VertebraModel& model,
                                              const Transform<World, Vertebra>& world_from_vertebra,
                                              std::span<const Point<World>> points,
                                              std::span<const Vec3> shafts_in_world);

}  // namespace orthonav::nav
