#pragma once

#include <string>

#include "engine/evaluation/evaluation.h"

namespace orthonav::tools {

/// A section of the page in which the spine turns with its planned and placed screws, as it lay in
/// the scan (data/evaluation.js). A vertebra whose mesh has more than 65,535 vertices is left out;
/// empty where none remains.
[[nodiscard]] std::string rotating_spine(const engine::Case& subject,
                                         const engine::Evaluation& evaluation);

}  // namespace orthonav::tools
