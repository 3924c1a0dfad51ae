#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "hal/sim/error_model.h"

namespace orthonav::sim {

/// The instruments that `use_instrument` knows.
[[nodiscard]] std::vector<std::string> instrument_names();

/// Sets the values that depend on an instrument: bending, slip, how a screw follows its hole, and,
/// with a robot's arm, the hand. Known are `wire` (an unsupported K-wire), `cannula`, `sleeved
/// drill`, `screw` (in a hole made by a sleeved drill) and `robot arm`. Refuses any other name.
Status use_instrument(std::string_view name, ErrorModel& error_model);

/// Strokes as others made them on a bare sawbone pelvis, 2,000 points with an NDI pointer
/// (docs/real-measurements.md, bench_real_strokes): 0.43 mm above the model on average, SD 0.31 mm,
/// alike over some 30 mm of path.
void use_measured_strokes(ErrorModel& error_model);

}  // namespace orthonav::sim
