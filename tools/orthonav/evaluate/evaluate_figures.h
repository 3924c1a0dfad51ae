#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/evaluation/evaluation.h"

namespace orthonav::tools {

/// Number of SDs to either side that contain 95 % of normal errors.
inline constexpr double k95 = 1.96;

/// Words that the table and the page have in common.
inline constexpr const char* kNotFound = "not found: no metal lies there as planned";
inline constexpr const char* kBarelyIn = "less than 6 mm in the bone";
inline constexpr const char* kTouched = "touches another screw";
inline constexpr const char* kTipNotSeen =
    "its tip is not seen: no target, no depth, and the clearance is that of the part that is seen";

/// "A", or "A or B" where neither is 90 % probable; empty without a clearance.
[[nodiscard]] std::string grade_text(const engine::ScrewInScan& screw);

/// A table on standard output.
void print_figures(const engine::Evaluation& evaluation);

/// Every figure, units in the keys (docs/evaluation.md).
[[nodiscard]] nlohmann::ordered_json as_json(const engine::Evaluation& evaluation);

/// "shaft, 5.5 mm thick, 42 mm long, tip at (1.0, -20.3, 104.0) mm in the scan: outside the planned
/// vertebrae".
/// What slices farther apart than any that was tried can't tell; empty for finer ones.
[[nodiscard]] std::string slices_text(const engine::Evaluation& evaluation);
[[nodiscard]] std::string text_of(const engine::UnassignedMetal& metal,
                                  const engine::Evaluation& evaluation);

/// Whether every vertebra was registered to its bone and every planned screw found.
[[nodiscard]] bool is_complete(const engine::Evaluation& evaluation);

}  // namespace orthonav::tools
