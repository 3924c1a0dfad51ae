#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/result.h"
#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// Closest points of a surface by look-up: the point closest to a cell's centre stands for the
/// whole cell. Tens of times faster than SurfaceIndex, but wrong by up to about a cell: for a first
/// comparison of many poses. Immutable, thread-safe, no allocation in queries.
class ClosestGrid {
 public:
  /// Covers the mesh and `margin_m` around it; points outside use the nearest border cell.
  ClosestGrid(const TriangleMesh& mesh, const SurfaceIndex& surface, double cell_m,
              double margin_m);
  /// The same from the data that `closest_m` returned, without computing it again. Refuses data of
  /// another mesh: a different number of cells, or a point that is not the closest one in any of
  /// the hundred or so cells that are checked.
  static Result<ClosestGrid> restored(const TriangleMesh& mesh, const SurfaceIndex& surface,
                                      double cell_m, double margin_m, std::vector<Vec3> closest_m);
  /// For every cell's centre, x running fastest.
  [[nodiscard]] std::span<const Vec3> closest_m() const { return closest_m_; }
  [[nodiscard]] Vec3 nearest(Vec3 query_m) const {
    return closest_m_[cell(0, query_m) + cell(1, query_m) + cell(2, query_m)];
  }

 private:
  ClosestGrid(const TriangleMesh& mesh, double cell_m, double margin_m);
  [[nodiscard]] std::size_t cells() const;
  [[nodiscard]] Vec3 centre_m(std::size_t cell) const;
  /// Its part of the cell's index along this axis; NaN falls into the first cell.
  [[nodiscard]] std::size_t cell(int axis, Vec3 query_m) const {
    const auto k = static_cast<std::size_t>(axis);
    const double at = (query_m[axis] - low_m_[axis]) / cell_m_;
    const std::size_t i = at > 0.0 ? (at < last_[k] ? static_cast<std::size_t>(at)
                                                    : static_cast<std::size_t>(last_[k]))
                                   : 0;
    return i * stride_[k];
  }

  Vec3 low_m_;
  double cell_m_;
  std::array<double, 3> last_{};  ///< the last cell's index
  std::array<std::size_t, 3> stride_{};
  std::vector<Vec3> closest_m_;
};

}  // namespace orthonav::nav
