#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// How each level of a report.json was registered.
[[nodiscard]] std::string levels_section(const nlohmann::json& report);
/// The rods of a report.json.
[[nodiscard]] std::string rods_section(const nlohmann::json& report);

}  // namespace orthonav::engine
