#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/transform.h"
#include "nav/registration/vertebra_model.h"

namespace orthonav::nav {

/// A pose, and the mean cost of the points there (m²; squared distances, truncated).
struct FoundPose {
  Transform<World, Vertebra> world_from_vertebra;
  double cost_m2 = 0.0;
};

/// Two poses closer than both of these count as one.
inline constexpr double kSamePose_m = 0.003;
inline constexpr double kSamePose_rad = 0.1;

/// The poses at which the points could lie on the surface, to a few tenths of a millimetre, the
/// best first, at most `most`. `tip_radius_m`: of the ball at the pointer's end, whose centre the
/// points are. Every orientation (a low-discrepancy set, 12° apart on average; Alexa 2022,
/// "Super-Fibonacci spirals") and every place is examined coarsely; hundreds are then refined in
/// the distance field by robust Gauss-Newton steps. Needs no start, no prior and no axis of the
/// strokes. Empty where the points lie in fewer than 6 cells of 4 mm.
[[nodiscard]] std::vector<FoundPose> search_poses(const SearchField& vertebra,
                                                  std::span<const Point<World>> points,
                                                  double tip_radius_m, std::size_t most);

/// The best result of the last of these refinements, from starts within a few millimetres; at least
/// one.
[[nodiscard]] FoundPose refined_pose(const SearchField& vertebra,
                                     std::span<const Point<World>> points,
                                     std::span<const Transform<World, Vertebra>> starts,
                                     double tip_radius_m);

/// Starts for it where World and Vertebra nearly agree: the identity, and shifts by 3 mm and turns
/// by 9° about a centre to every side.
[[nodiscard]] std::vector<Transform<World, Vertebra>> poses_beside(Vec3 centre_m);

}  // namespace orthonav::nav
