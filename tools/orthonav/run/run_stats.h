#pragma once

#include "engine/live/frame_loop.h"
#include "engine/live/presenter.h"
#include "hal/api/object_display.h"

namespace orthonav::tools {

// Medians and 99th percentiles of what a frame takes, on standard error with the other messages.

void print_stats(const engine::LoopReport& loop);
void print_stats(const engine::PresentReport& report);
void print_stats(const ObjectDisplayStatistics& objects);

}  // namespace orthonav::tools
