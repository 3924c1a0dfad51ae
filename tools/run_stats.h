#pragma once

#include "engine/live/frame_loop.h"
#include "engine/live/presenter.h"

namespace orthonav::tools {

// Medians and p99 of what a frame takes, on standard error beside the other messages.

void print_stats(const engine::LoopReport& loop);
void print_stats(const engine::PresentReport& report);

}  // namespace orthonav::tools
