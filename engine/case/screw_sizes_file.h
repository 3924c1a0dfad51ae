#pragma once

#include <string>

#include "base/result.h"
#include "engine/case/screw_sizes.h"

namespace orthonav::engine {

/// Reads the available screws: `{"screws": [{"diameter_mm", "lengths_mm": [...],
/// "head_to_seat_mm"?}]}`. Order does not matter. Refuses in one line, with file and field, fields
/// that are missing, of the wrong type or not finite numbers, a diameter or length that is given
/// twice, and problems that `ScrewSizes::check` finds.
Result<ScrewSizes> load_screw_sizes(const std::string& path);

}  // namespace orthonav::engine
