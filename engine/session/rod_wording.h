#pragma once

#include <string>

#include "base/translation.h"
#include "engine/session/message.h"
#include "engine/session/rod_in_hand.h"
#include "engine/session/status_line.h"
#include "engine/session/status_parts.h"

namespace orthonav::engine {

// A rod in hand in words: a part of engine/session/wording.h.

/// "bend 2: 63 mm, roll 40°, set 18.5°".
void append_next_bend(std::string& out, const NextBend& bend);
/// "cut to 112.4 mm".
void append_cut(std::string& out, double length_m);
/// "bend 1: 12.1 ± 0.3°; bend 2: 63 mm, roll 40°, set 18.5°, then say go to next".
void write_rod_in_hand(PartedText text, const RodInHandSoFar& rod);
void write_rod_not_measured(PartedText text, const RodNotMeasured& message);

// For `translated`.
namespace words {
inline constexpr const char* kWhereStroked = translatable("where it was stroked");
}  // namespace words

}  // namespace orthonav::engine
