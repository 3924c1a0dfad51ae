#pragma once

#include <string>
#include <string_view>

#include "engine/session/placed_wire.h"
#include "engine/session/status_line.h"

namespace orthonav::engine {

// The measurement of a wire in words: a part of engine/session/wording.h.

/// "0.8 ± 0.4°, 0.6 ± 0.3 mm".
void append_wire(std::string& out, const PlacedWire& wire);
/// "placed: 2.6 ± 0.4°, 0.6 ± 0.3 mm from the plan; angle 2.6°, limit 2.0°: say accept result to
/// keep it, delete last to redo it".
void write_wire(PartedText text, const WireSoFar& state, std::string_view separator);

}  // namespace orthonav::engine
