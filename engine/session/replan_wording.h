#pragma once

#include <string>

#include "engine/session/replan.h"
#include "engine/session/status_line.h"

namespace orthonav::engine {

// Changes of a screw in words: a part of engine/session/wording.h.

/// "6.0 × 45 mm"; "45 mm long" if no diameter is stated.
void append_size(std::string& out, double diameter_m, double length_m);
/// "entry moved 1.0 mm cranial, aims 2.0° more medial, 6.0 × 45 mm instead of 5.5 × 40 mm"; "no
/// difference" if all of it rounds to zero.
[[nodiscard]] std::string text_of(const nav::ScrewDifference& difference);
/// What the surgeon asked for: "move cranial 1.0 mm", "undo".
[[nodiscard]] std::string text_of(const Replan& replan);

void write(PartedText text, const ReplanRefusal& refusal);
void write(PartedText text, const ScrewReplanned& done);

}  // namespace orthonav::engine
