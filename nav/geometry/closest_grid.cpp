#include "nav/geometry/closest_grid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace orthonav::nav {

ClosestGrid::ClosestGrid(const TriangleMesh& mesh, double cell_m, double margin_m)
    : cell_m_(cell_m) {
  const Bounds box = bounds_of(mesh);
  const Vec3 margin{margin_m, margin_m, margin_m};
  low_m_ = box.low - margin;
  const Vec3 high = box.high + margin;
  std::size_t cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    last_[k] = std::floor((high[axis] - low_m_[axis]) / cell_m);
    stride_[k] = cells;
    cells *= static_cast<std::size_t>(last_[k]) + 1;
  }
}

std::size_t ClosestGrid::cells() const {
  return stride_[2] * (static_cast<std::size_t>(last_[2]) + 1);
}

Vec3 ClosestGrid::centre_m(std::size_t cell) const {
  const auto x = static_cast<double>(cell % stride_[1]);
  const auto y = static_cast<double>(cell % stride_[2] / stride_[1]);
  const auto z = static_cast<double>(cell / stride_[2]);
  return low_m_ + cell_m_ * Vec3{x + 0.5, y + 0.5, z + 0.5};
}

ClosestGrid::ClosestGrid(const TriangleMesh& mesh, const SurfaceIndex& surface, double cell_m,
                         double margin_m)
    : ClosestGrid(mesh, cell_m, margin_m) {
  const std::size_t count = cells();
  closest_m_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 centre = centre_m(i);
    // The neighbour's closest point lies on the surface, so the closest point is no farther than
    // it.
    const double within_m =
        i % stride_[1] > 0 ? (closest_m_.back() - centre).norm() * (1.0 + 1e-12) + 1e-15 : 1e9;
    const auto found = surface.nearest(centre, within_m);
    closest_m_.push_back(found ? found->point_m : closest_m_.back());
  }
}

Result<ClosestGrid> ClosestGrid::restored(const TriangleMesh& mesh, const SurfaceIndex& surface,
                                          double cell_m, double margin_m,
                                          std::vector<Vec3> closest_m) {
  constexpr std::size_t kLookedAt = 300;
  constexpr double kSame_m = 1e-9;
  ClosestGrid grid(mesh, cell_m, margin_m);
  const std::size_t count = grid.cells();
  if (closest_m.size() != count) {
    return Error{"closest points of " + std::to_string(closest_m.size()) + " cells, the mesh has " +
                 std::to_string(count)};
  }
  const bool finite =
      std::all_of(closest_m.begin(), closest_m.end(), [](const Vec3& p) { return p.is_finite(); });
  if (!finite) {
    return Error{"closest points are not all finite"};
  }
  for (std::size_t i = 0; i < count; i += std::max<std::size_t>(1, count / kLookedAt)) {
    const Vec3 centre = grid.centre_m(i);
    const auto here = surface.nearest(centre);
    const auto there = surface.nearest(closest_m[i], kSame_m);
    if (!here || !there || std::abs((closest_m[i] - centre).norm() - here->distance_m) > kSame_m) {
      return Error{"closest points are of another mesh (cell " + std::to_string(i) + ")"};
    }
  }
  grid.closest_m_ = std::move(closest_m);
  return grid;
}

}  // namespace orthonav::nav
