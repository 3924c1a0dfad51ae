#pragma once

#include <vector>

#include "nav/calibration/body_adjustment.h"

namespace orthonav::nav {

/// The adjustment repeated without each tenth of the pairs in turn, starting from the result with
/// all of them. If a result depends on one tenth alone (a tag seen only in it), leaving that tenth
/// out gives no state: fewer than ten states are returned.
[[nodiscard]] std::vector<BodyState> adjusted_without_blocks(const BodyProblem& problem,
                                                             const BodyState& whole);

}  // namespace orthonav::nav
