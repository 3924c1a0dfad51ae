#pragma once

#include <string>

#include "engine/study/sensitivity.h"

namespace orthonav::engine {

/// The result of `sensitivities` as one HTML page: bars of mu* with the SD of the effects, and the
/// table.
[[nodiscard]] std::string sensitivity_html(const std::vector<Sensitivity>& found,
                                           const SensitivityOptions& options);

}  // namespace orthonav::engine
