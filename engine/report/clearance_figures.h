#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/report/operation_result.h"

namespace orthonav::engine {

/// A screw's clearance to the cortex in report.json: `planned` and `tracked`, each with
/// `clearance_mm`, `grade` and where it is least (`arc_mm`, `towards`), and, if the uncertainty is
/// known, `clearance_95_mm` and `grade_probability`; `clearance_mm` and `grade` of the screw itself
/// are the true ones. Unknown values are left out.
void put_clearance(nlohmann::ordered_json& screw_json, const ScrewOutcome& screw);

}  // namespace orthonav::engine
