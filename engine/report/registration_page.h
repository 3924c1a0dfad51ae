#pragma once

#include <span>
#include <string>

#include "engine/report/registration_figures.h"

namespace orthonav::engine {

/// One registration as a section of an HTML page: the drawing from three sides, its certainty in
/// plain words, every figure with its limit and meaning, and every screw. The style is
/// data/report.css. The same registration gives the same bytes.
Result<std::string> registration_section(const RegisteredLevel& level);

/// One section for each level, with all drawings and all error ellipsoids at one scale.
Result<std::string> registration_sections(std::span<const RegisteredLevel> levels);

/// That section as a separate self-contained page. `source` names the input: "points.csv".
Result<std::string> registration_page(const RegisteredLevel& level, const std::string& source);

}  // namespace orthonav::engine
