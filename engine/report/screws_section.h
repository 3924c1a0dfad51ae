#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// Every screw of a report.json, placed or not: its planned size, its deviation from the plan, its
/// depth and clearance, and its placed wire.
[[nodiscard]] std::string screws_section(const nlohmann::json& report);

}  // namespace orthonav::engine
