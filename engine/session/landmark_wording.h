#pragma once

#include <string_view>

#include "engine/session/status_line.h"

namespace orthonav::engine {

// The landmark in words: a part of engine/session/wording.h.

/// Whether the landmark is still to be touched, and the result of the last touch.
void write_landmark(PartedText text, const LandmarkSoFar& landmark, std::string_view separator);
/// After the outcome of a correction of the guide: what its touch asks for next.
void write_beside_correction(PartedText text, const LandmarkSoFar& landmark);

}  // namespace orthonav::engine
