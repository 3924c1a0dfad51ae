#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace orthonav::engine {

/// Measurements that need no ground truth, of a report: where each tool went with its SDs, the
/// probability of each grade, and the calibration found in use for tags and cameras. Values not
/// measured are marked as such, values missing from an older report as not recorded.
[[nodiscard]] std::string tracked_section(const nlohmann::json& report);

}  // namespace orthonav::engine
