#pragma once

#include <string>
#include <vector>

#include "nav/geometry/mesh.h"
#include "tests/support/stroke_walk.h"

namespace orthonav::test {

/// The movements made, and their coverage in words.
struct StrokeCoverage {
  std::vector<Walk> walks;
  std::string words;
};

/// Everything that is reachable from behind, with a total length of `length_m`, or as near as
/// possible with lanes between 1.5 and 6 mm apart.
[[nodiscard]] StrokeCoverage cover_all(const TouchableBone& bone, const PosteriorLandmarks& marks,
                                       double length_m, Random& random);

/// A randomly chosen part of it: one side and the spinous process, the laminae, the spinous process
/// and one lamina or facet, or all but the upper or lower third of one side.
[[nodiscard]] StrokeCoverage cover_part(const TouchableBone& bone, const PosteriorLandmarks& marks,
                                        double length_m, Random& random);

/// About `count` short strokes all over it.
[[nodiscard]] StrokeCoverage cover_sparsely(const TouchableBone& bone,
                                            const PosteriorLandmarks& marks, double length_m,
                                            int count, Random& random);

}  // namespace orthonav::test
