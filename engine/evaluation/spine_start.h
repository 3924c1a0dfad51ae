#pragma once

#include <span>
#include <vector>

#include "engine/case/case.h"
#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// Possible poses of the case's spine in the scan, most likely first: two planned screws aligned
/// with two shafts (all pairs of both), or one with one by the smallest turn, ranked by how many
/// planned screws then have a shaft nearby; last, the pose in the case. The patient may be turned
/// by up to 45° relative to the case. Of nearly equal starts only one is returned; at most `most`
/// in all.
[[nodiscard]] std::vector<Transform<Scan, Spine>> spine_starts(const Case& subject,
                                                               std::span<const Shaft> shafts,
                                                               std::size_t most);

}  // namespace orthonav::engine
