#pragma once

#include <string>

#include "engine/holograms/visibility.h"

namespace orthonav::engine {

// The words of step `guide`, from what a frame shows: a frame that lost its tool does not ask for
// what only a measured one allows.

/// What to do next: "tip to the entry", "turn the tool", "drill". Nothing in other steps, whose
/// status line says it, and while a stop is shown.
void append_next_act(std::string& out, const Guidance& guidance, const Visibility& visible);
/// Above the cross, at most one: "stop", or "may break through medially". Mostly nothing.
void append_cross_word(std::string& out, const Visibility& visible);

}  // namespace orthonav::engine
