#pragma once

#include <deque>
#include <string>

#include "engine/holograms/shapes/hologram_shapes.h"
#include "engine/session/session.h"

namespace orthonav::tools {

/// The state for onlookers after a pair, as JSON: step, status line, the numbers as displayed to
/// the surgeon, their certainty, levels with their screws, tools, and the newest messages. It
/// contains only numbers that are shown to the surgeon.
[[nodiscard]] std::string dashboard_state(const engine::Session& session,
                                          const engine::Guidance& guidance,
                                          const engine::GradeLimits& limits, double time_s,
                                          const std::deque<std::string>& messages);

}  // namespace orthonav::tools
