#pragma once

#include <vector>

#include "nav/calibration/body_adjustment.h"

namespace orthonav::nav {

/// The adjustments without each tenth of the pairs in turn, begun where the one with all of them
/// ended. Without a tenth on which something depends that was to be found (a tag seen in it alone)
/// there is none: fewer than ten states come back.
[[nodiscard]] std::vector<BodyState> adjusted_without_blocks(const BodyProblem& problem,
                                                             const BodyState& whole);

}  // namespace orthonav::nav
