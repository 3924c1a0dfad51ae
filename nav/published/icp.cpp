#include "nav/published/icp.h"

#include <cmath>
#include <limits>
#include <vector>

#include "nav/geometry/absolute_orientation.h"

namespace orthonav::nav::published {
namespace {

/// Closest points of the surface to the digitized points under one pose; keeps the last ones, which
/// bound the next search.
class Correspondences {
 public:
  Correspondences(const SurfaceIndex& surface, std::span<const Point<World>> points)
      : surface_(surface), points_(points), closest_(points.size()) {}

  /// RMSE of the distances.
  double update(const Transform<World, Vertebra>& world_from_vertebra) {
    const Transform<Vertebra, World> inverse = world_from_vertebra.inverse();
    double sum_m2 = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vec3 query_m = (inverse * points_[i]).v;
      // The last closest point lies on the surface, so the closest one is no farther.
      const double within_m = first_ ? 1e9 : (closest_[i] - query_m).norm() * (1 + 1e-12) + 1e-15;
      if (const auto found = surface_.nearest(query_m, within_m)) {
        closest_[i] = found->point_m;
      }
      sum_m2 += (closest_[i] - query_m).squared_norm();
    }
    first_ = false;
    return std::sqrt(sum_m2 / static_cast<double>(points_.size()));
  }
  [[nodiscard]] std::span<const Vec3> closest() const { return closest_; }

 private:
  const SurfaceIndex& surface_;
  std::span<const Point<World>> points_;
  std::vector<Vec3> closest_;
  bool first_ = true;
};

}  // namespace

Result<IcpResult> refine_icp(const SurfaceIndex& surface,
                             std::span<const Point<World>> points_in_world,
                             const Transform<World, Vertebra>& start, const IcpOptions& options) {
  std::vector<Vec3> digitized(points_in_world.size());
  for (std::size_t i = 0; i < digitized.size(); ++i) {
    digitized[i] = points_in_world[i].v;
  }
  Correspondences correspondences(surface, points_in_world);
  IcpResult result{start, correspondences.update(start), 0};
  while (result.iterations < options.max_iterations) {
    const auto fit = absolute_orientation(correspondences.closest(), digitized);
    if (!fit) {
      return fit.error();
    }
    result.world_from_vertebra = {fit->rotation, fit->translation_m};
    const double before_m = result.rmse_m;
    result.rmse_m = correspondences.update(result.world_from_vertebra);
    ++result.iterations;
    if (!(before_m - result.rmse_m > options.converged_m)) {
      break;
    }
  }
  return result;
}

}  // namespace orthonav::nav::published
