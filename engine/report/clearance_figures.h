#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/report/operation_result.h"

namespace orthonav::engine {

/// What report.json says of a screw's clearance to the cortex: `planned` and `tracked`, each with
/// `clearance_mm`, `grade` and where it is least (`arc_mm`, `towards`), and where the uncertainty
/// is known `clearance_95_mm` and `grade_probability`; `clearance_mm` and `grade` of the screw
/// itself are those of the truth. What report.json lacks is absent.
void put_clearance(nlohmann::ordered_json& screw_json, const ScrewOutcome& screw);

}  // namespace orthonav::engine
