#pragma once

#include <optional>
#include <string>

#include "hal/open/open.h"

namespace orthonav {

/// The registered scheme of this name, if there is one.
[[nodiscard]] std::optional<HeadsetScheme> registered_scheme(const std::string& name);

/// "known are sim:, replay:PATH, ... and mine:SERIAL".
[[nodiscard]] std::string known_schemes();

}  // namespace orthonav
