#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {

/// How a screw was planned in surgery, as numbers and as text, into its part of a report; nothing
/// where it was not.
void put_planned_in_surgery(nlohmann::ordered_json& screw_json,
                            const std::optional<nav::ScrewDifference>& difference);

}  // namespace orthonav::engine
