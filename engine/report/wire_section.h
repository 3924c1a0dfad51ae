#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// Of a screw of report.json, how its wire was measured with the sleeve over it: "0.8 ± 0.4°, 0.6
/// ± 0.3 mm, kept; redone", "not measured", or a dash where nobody was asked to.
[[nodiscard]] std::string wire_as_placed(const nlohmann::json& screw);

}  // namespace orthonav::engine
