#pragma once

#include "engine/report/registration_drawing.h"

namespace orthonav::engine {

/// A view from behind, as HTML: the height of the tip above the bone, where to press it to the bone
/// next, and a legend. Empty if there is no evidence of tissue.
Result<std::string> tissue_figure(const RegisteredLevel& level, const RegistrationScene& scene);

}  // namespace orthonav::engine
