#pragma once

#include <span>
#include <vector>

#include "base/transform.h"
#include "nav/registration/registration.h"

namespace orthonav::nav {

/// The surface that the strokes left out, one value per vertex of the model's mesh: 1 where a
/// pointer could have stroked but no point lies within 6 mm, 0 where a point lies within 4 mm or
/// the pointer can't reach, and proportional in between. Where it is 1 the registration is an
/// inference, not a measurement.
[[nodiscard]] std::vector<float> unstroked_surface(
    const VertebraModel& model, const Transform<World, Vertebra>& world_from_vertebra,
    std::span<const Point<World>> points);

}  // namespace orthonav::nav
