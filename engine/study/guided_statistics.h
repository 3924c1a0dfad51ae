#pragma once

#include <nlohmann/json_fwd.hpp>

namespace orthonav::engine {

/// Of a study's runs: how far off the guide was shown when wires pierced the bone, screws guided
/// more than `kSilent_mm` off across the plan without anybody being told, and breaches of the
/// cortex without a warning (ScrewOutcome::warned); each count with the upper limit of its fraction
/// (95 %, Clopper and Pearson 1934). Null where no screw has these figures.
[[nodiscard]] nlohmann::ordered_json guided_quality_json(const nlohmann::ordered_json& runs);

inline constexpr double kSilent_mm = 2.0;

}  // namespace orthonav::engine
