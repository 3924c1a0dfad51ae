#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// Distance to a surface by look-up: sampled on a grid, trilinear in between, negative inside the
/// bone. Off by a few tenths of a cell where the surface bends within one, and by up to a tenth of
/// a cell more from 2.5 cells off: good enough for finding poses, not for the last step. Immutable,
/// thread-safe, no allocation in queries.
class DistanceField {
 public:
  /// Distance to the surface of `near`, with the sign from the closed surface `bone`. Covers
  /// `mesh`, of which `near` is the index, and `margin_m` around it.
  DistanceField(const TriangleMesh& mesh, const SurfaceIndex& near, const SurfaceIndex& bone,
                double cell_m, double margin_m);

  struct Value {
    double distance_m = 0.0;
    Vec3 gradient;  ///< approximately of unit length
  };
  /// Returns false outside the grid, where a point is farther than the margin from the surface.
  [[nodiscard]] bool at(Vec3 query_m, Value& value) const;

  [[nodiscard]] const Bounds& bounds() const { return bounds_; }

 private:
  [[nodiscard]] std::size_t sample(int x, int y, int z) const;
  [[nodiscard]] std::array<int, 3> indices(std::size_t sample) const;
  [[nodiscard]] Vec3 place_m(std::size_t sample) const;

  Bounds bounds_;
  double cell_m_;
  std::array<int, 3> size_{};  ///< samples along each axis
  std::vector<float> distance_m_;
};

}  // namespace orthonav::nav
