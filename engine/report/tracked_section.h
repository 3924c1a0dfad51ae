#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// What was measured without a truth, of a report of an operation or of a journal: where each tool
/// went with its SDs, the probability of each grade, and what was found out in use about tags and
/// cameras. What was not measured is said as that, what an older journal does not hold as not
/// recorded.
[[nodiscard]] std::string tracked_section(const nlohmann::json& report);

}  // namespace orthonav::engine
