#pragma once

#include <optional>
#include <string>

#include "hal/open/open.h"

namespace orthonav {

/// The scheme of this name that was registered; none where nobody did.
[[nodiscard]] std::optional<HeadsetScheme> registered_scheme(const std::string& name);

/// "known are sim:, replay:PATH, ... and mine:SERIAL".
[[nodiscard]] std::string known_schemes();

}  // namespace orthonav
