#pragma once

#include <optional>

#include "engine/io/json_document.h"
#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {

/// How a screw differs from its preoperative plan, from a journal's line about a change; none if
/// that plan is in use again.
[[nodiscard]] std::optional<nav::ScrewDifference> planned_in_surgery(const JsonNode& line);

}  // namespace orthonav::engine
