#pragma once

#include <span>
#include <vector>

#include "engine/case/case.h"
#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// A patient who lies turned by more than this against the case is not sought.
inline constexpr double kMostTurned_rad = 0.7854;

/// Where the spine of the case may lie in the scan, likeliest first: as two planned screws lie on
/// two shafts (all pairs of both), or one on one with the least turn, ranked by how many planned
/// screws then have a shaft beside them; last, as the case itself has it. Those that are nearly
/// alike are given once, and `most` at most.
[[nodiscard]] std::vector<Transform<Scan, Spine>> spine_starts(const Case& subject,
                                                               std::span<const Shaft> shafts,
                                                               std::size_t most);

}  // namespace orthonav::engine
