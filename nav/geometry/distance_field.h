#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// Distance to a surface by look-up: sampled on a grid, trilinear in between, negative inside the
/// bone. Off by a few tenths of a cell where the surface bends within one: good enough for finding
/// poses, not for the last step. Immutable, thread-safe, no allocation in queries.
class DistanceField {
 public:
  /// Distance to the surface of `near`, with the sign from the closed surface `bone`. Covers
  /// `mesh`, of which `near` is the index, and `margin_m` around it.
  DistanceField(const TriangleMesh& mesh, const SurfaceIndex& near, const SurfaceIndex& bone,
                double cell_m, double margin_m);
  /// The same from the data that `samples_m` returned, without computing it again. Refuses data of
  /// other surfaces: a different number of samples, or a wrong distance at any of the hundred or so
  /// places that are checked.
  static Result<DistanceField> restored(const TriangleMesh& mesh, const SurfaceIndex& near,
                                        const SurfaceIndex& bone, double cell_m, double margin_m,
                                        std::vector<float> samples_m);
  /// At the corners of the cells, x running fastest.
  [[nodiscard]] std::span<const float> samples_m() const { return distance_m_; }

  struct Value {
    double distance_m = 0.0;
    Vec3 gradient;  ///< approximately of unit length
  };
  /// Returns false outside the grid, where a point is farther than the margin from the surface.
  [[nodiscard]] bool at(Vec3 query_m, Value& value) const;

  [[nodiscard]] const Bounds& bounds() const { return bounds_; }

 private:
  DistanceField(const TriangleMesh& mesh, double cell_m, double margin_m);
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] Vec3 place_m(std::size_t sample) const;

  Bounds bounds_;
  double cell_m_;
  std::array<int, 3> size_{};  ///< samples along each axis
  std::vector<float> distance_m_;
};

}  // namespace orthonav::nav
