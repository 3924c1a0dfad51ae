#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// The figures of a report.json beside the published ones, each with the number of values in its
/// mean. In a simulation, values that were inputs are marked as such. `beside`: the report.json of
/// another run, empty without one, and its page.
[[nodiscard]] std::string paper_section(const nlohmann::json& report, const nlohmann::json& beside,
                                        const std::string& beside_page);

}  // namespace orthonav::engine
