#pragma once

#include <deque>
#include <string>

#include "engine/holograms/hologram_shapes.h"
#include "engine/session/session.h"

namespace orthonav::tools {

/// What somebody who looks on is told after a pair, as JSON: step, status line, the numbers as the
/// surgeon reads them, how sure they are, levels with their screws, tools, and the newest messages.
/// Numbers are there only where the surgeon is shown them.
[[nodiscard]] std::string dashboard_state(const engine::Session& session,
                                          const engine::Guidance& guidance,
                                          const engine::GradeLimits& limits, double time_s,
                                          const std::deque<std::string>& messages);

}  // namespace orthonav::tools
