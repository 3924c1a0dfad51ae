#pragma once

#include "engine/report/registration_drawing.h"

namespace orthonav::engine {

/// From behind, as HTML: how high the tip stood above the bone, where to press it to the bone next,
/// and what the colours mean. Empty where nothing tells of tissue.
Result<std::string> tissue_figure(const RegisteredLevel& level, const RegistrationScene& scene);

}  // namespace orthonav::engine
