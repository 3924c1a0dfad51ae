#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {

/// Adds to a screw's part of a report how it was replanned in surgery, as numbers and as text;
/// nothing if it was not.
void put_planned_in_surgery(nlohmann::ordered_json& screw_json,
                            const std::optional<nav::ScrewDifference>& difference);

}  // namespace orthonav::engine
