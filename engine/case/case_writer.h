#pragma once

#include <string>

#include "base/result.h"
#include "engine/case/case.h"

namespace orthonav::engine {

/// The file of a level's surface: "L4.stl".
[[nodiscard]] std::string model_name(const std::string& label);

/// Writes a case into an existing folder: a binary STL for each level and a plan for each level
/// with screws, all in millimetres and LPS, and last `case.json`, so that a folder with one is
/// complete. `load_case` reads the same back, to float precision. Refuses a folder that has a
/// `case.json`, and a case with a label that can't be a file name.
Status save_case(const std::string& folder, const Case& subject);

/// Refuses a case with a label that can't be a file name.
Status check_labels(const Case& subject);

/// Adds plans to a case folder: writes `LABEL.plan.json` for each level of `planned` with screws
/// that has no plan in `case.json`, then `case.json` with their names; its other content stays.
/// Refuses, before anything is written, a level that has a plan already and a case that is not in
/// millimetres (a model without a plan is read in the case's unit, with one in the plan's).
Status add_plans(const std::string& folder, const Case& planned);

}  // namespace orthonav::engine
