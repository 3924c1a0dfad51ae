#pragma once

#include <string>

#include "engine/report/registration_figures.h"

namespace orthonav::engine {

/// Every figure of a registration with its limit and meaning, as a table of a page.
[[nodiscard]] std::string figures_table(const RegisteredLevel& level);
/// The errors to expect at each entry and target; empty where no screw is known.
[[nodiscard]] std::string screws_table(const RegisteredLevel& level);

}  // namespace orthonav::engine
