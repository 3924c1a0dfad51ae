#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// Every screw of a report.json, placed or not: its planned size, how far it is from the plan, its
/// depth and clearance, and its wire as placed.
[[nodiscard]] std::string screws_section(const nlohmann::json& report);

}  // namespace orthonav::engine
