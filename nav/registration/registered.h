#pragma once

#include <span>

#include "base/result.h"
#include "nav/registration/registration.h"

namespace orthonav::nav::posterior {

/// What all explanations of the points say together, as the answer to a registration: pose,
/// uncertainty, heights, size and what speaks against it are read off the same mixture. Of the
/// options, the targets, the limits of the error and of the size, shafts, neighbours, tip
/// and the model's least error count.
[[nodiscard]] Result<Registration> register_by_posterior(
    const VertebraModel& model, std::span<const Point<World>> points_in_world,
    const PoseSearchRegistrationOptions& options = {});

}  // namespace orthonav::nav::posterior
