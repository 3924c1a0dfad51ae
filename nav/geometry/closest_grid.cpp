#include "nav/geometry/closest_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orthonav::nav {

ClosestGrid::ClosestGrid(const TriangleMesh& mesh, const SurfaceIndex& surface, double cell_m,
                         double margin_m)
    : cell_m_(cell_m) {
  const Bounds box = bounds_of(mesh);
  const Vec3 margin{margin_m, margin_m, margin_m};
  const Vec3 low = box.low - margin;
  const Vec3 high = box.high + margin;
  low_m_ = low;
  std::size_t cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    last_[k] = std::floor((high[axis] - low[axis]) / cell_m);
    stride_[k] = cells;
    cells *= static_cast<std::size_t>(last_[k]) + 1;
  }
  closest_m_.reserve(cells);
  for (double z = 0.0; z <= last_[2]; ++z)
    for (double y = 0.0; y <= last_[1]; ++y)
      for (double x = 0.0; x <= last_[0]; ++x) {
        const Vec3 centre = low + cell_m * Vec3{x + 0.5, y + 0.5, z + 0.5};
        // The neighbour's closest point lies on the surface, so nothing closer is farther away.
        const double within_m =
            x > 0.0 ? (closest_m_.back() - centre).norm() * (1.0 + 1e-12) + 1e-15 : 1e9;
        const auto found = surface.nearest(centre, within_m);
        closest_m_.push_back(found ? found->point_m : closest_m_.back());
      }
}

}  // namespace orthonav::nav
