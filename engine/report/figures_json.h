#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "engine/session/calibration_in_use.h"
#include "engine/session/known_errors.h"
#include "nav/guidance/changed_screw.h"
#include "nav/guidance/executed_trajectory.h"
#include "nav/guidance/screw_clearance.h"

namespace orthonav::engine {

// Figures of report.json (docs/file-formats.md), in mm, degrees and percent.

/// Where the tool of a screw that is done went, in the vertebra's frame, with its covariances where
/// they are known; and what was not measured of it or of its clearance, by name.
void put_executed(nlohmann::ordered_json& screw_json,
                  const std::optional<nav::ExecutedTrajectory>& executed,
                  const std::optional<nav::ScrewClearance>& at_depth);
/// The probability of each grade, A to E.
[[nodiscard]] nlohmann::ordered_json grades_json(
    const std::array<double, nav::kPedicleGrades>& probability);
/// How a screw was replanned in surgery, as numbers and as text; nothing if it was not.
void put_planned_in_surgery(nlohmann::ordered_json& screw_json,
                            const std::optional<nav::ScrewDifference>& difference);
/// `tags[]` and `cameras`; `not_measured[]` names those not measured.
[[nodiscard]] nlohmann::ordered_json calibration_json(const CalibrationInUse& found);
/// Each error with its source.
[[nodiscard]] nlohmann::ordered_json errors_json(const ErrorsInUse& errors);

}  // namespace orthonav::engine
