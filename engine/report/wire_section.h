#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// For a screw of report.json, the measurement of its wire with the sleeve over it: "0.8 ± 0.4°,
/// 0.6 ± 0.3 mm, kept; redone", "not measured", or a dash if none was requested.
[[nodiscard]] std::string wire_as_placed(const nlohmann::json& screw);

}  // namespace orthonav::engine
