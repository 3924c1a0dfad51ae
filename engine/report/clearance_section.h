#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// A section of the report's page, of the figures in report.json: each screw's clearance to the
/// cortex as planned, as tracked and against the truth, with bounds and grades. Empty where no
/// screw has one.
[[nodiscard]] std::string clearance_section(const nlohmann::json& report);

}  // namespace orthonav::engine
