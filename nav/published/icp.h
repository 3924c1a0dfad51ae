#pragma once

#include <span>

#include "base/result.h"
#include "base/transform.h"
#include "nav/geometry/mesh.h"

namespace orthonav::nav::published {

struct IcpOptions {
  int max_iterations = 200;
  double converged_m = 1e-8;  ///< a smaller change of the RMSE ends it; ICP converges slowly
};

struct IcpResult {
  Transform<World, Vertebra> world_from_vertebra;
  double rmse_m = 0.0;  ///< of the closest points at that pose
  int iterations = 0;
};

/// Iterative closest points (Besl & McKay 1992), point to point, every point with equal weight.
/// Each step lowers the RMSE, so it ends in the nearest minimum, not the best one: the result
/// depends on the start. An Error if the closest points are collinear.
Result<IcpResult> refine_icp(const SurfaceIndex& surface,
                             std::span<const Point<World>> points_in_world,
                             const Transform<World, Vertebra>& start,
                             const IcpOptions& options = {});

}  // namespace orthonav::nav::published
