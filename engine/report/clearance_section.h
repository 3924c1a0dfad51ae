#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// A section of the report's page, from the figures in report.json: each screw's planned, tracked
/// and true clearance to the cortex, with bounds and grades. Empty if no screw has one.
[[nodiscard]] std::string clearance_section(const nlohmann::json& report);

}  // namespace orthonav::engine
