#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// The figures of a report.json beside the published ones, each with how many it is the mean of.
/// In a simulation, what was put into it is said to be an input.
[[nodiscard]] std::string paper_section(const nlohmann::json& report);

}  // namespace orthonav::engine
