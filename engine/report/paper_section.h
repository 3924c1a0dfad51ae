#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// The figures of a report.json beside the published ones, each with the number of values in its
/// mean. In a simulation, values that were inputs are marked as such.
[[nodiscard]] std::string paper_section(const nlohmann::json& report);

}  // namespace orthonav::engine
