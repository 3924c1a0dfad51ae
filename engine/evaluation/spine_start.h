#pragma once

#include <span>
#include <vector>

#include "engine/case/case.h"
#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// Where the spine of the case may lie in the scan, most likely first: two planned screws laid on
/// two shafts (all pairs of both), or one on one with the least turn, ranked by how many planned
/// screws then have a shaft beside them; last, as it lies in the case. The patient is turned by up
/// to 45° against the case. Of starts that are nearly alike one is given; at most `most` in all.
[[nodiscard]] std::vector<Transform<Scan, Spine>> spine_starts(const Case& subject,
                                                               std::span<const Shaft> shafts,
                                                               std::size_t most);

}  // namespace orthonav::engine
