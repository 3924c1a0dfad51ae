#pragma once

#include <optional>
#include <span>
#include <vector>

#include "nav/registration/registration.h"
#include "nav/registration/surface_fit.h"

namespace orthonav::nav {

/// Two poses that put every target within this distance count as the same.
inline constexpr double kSameAtTargets_m = 0.002;

/// Digitized points for the search.
struct Cloud {
  std::vector<Vec3> all_m;  ///< about the centre, in the order of time
  std::vector<Vec3> few_m;  ///< a subset, enough to tell candidates apart
  Vec3 centre_m;            ///< in World
};
[[nodiscard]] Cloud cloud_of(std::span<const Point<World>> points);

/// How far apart two poses put the farthest of the targets.
[[nodiscard]] double apart_m(const Transform<World, Vertebra>& a,
                             const Transform<World, Vertebra>& b,
                             std::span<const Point<Vertebra>> targets);

/// Fits points to the reachable surface; finds `SurfaceFitOptions::near_m` itself.
[[nodiscard]] std::optional<SurfaceFit> fit_to_bone(const VertebraModel& model,
                                                    std::span<const Vec3> points_m,
                                                    const CentredPose& start,
                                                    SurfaceFitOptions options);

struct Candidate {
  SurfaceFit fit;
  double cost_m2 = 0.0;  ///< mean squared distance, truncated at some SDs of the noise
};

/// Every pose that could explain the points, each fitted to `few_m`, the best first. If targets are
/// given, the search continues until one candidate differs from the first one at the targets.
[[nodiscard]] std::vector<Candidate> find_candidates(const VertebraModel& model, const Cloud& cloud,
                                                     std::span<const Point<Vertebra>> targets,
                                                     double tip_radius_m);

}  // namespace orthonav::nav
