#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "nav/geometry/mesh.h"

namespace orthonav::nav {

/// Distance to a surface, looked up: sampled on a grid, in between trilinear. Negative inside the
/// bone to 8 mm from the surface, positive elsewhere. Off by a few tenths of a cell where the
/// surface bends within one: for finding poses, not for the last step. Immutable, thread-safe, no
/// allocation in queries.
class DistanceField {
 public:
  /// To the surface of `near`; the sign by the closed surface `bone`. Covers `mesh`, of which
  /// `near` is the index, and `margin_m` around it.
  DistanceField(const TriangleMesh& mesh, const SurfaceIndex& near, const SurfaceIndex& bone,
                double cell_m, double margin_m);
  /// The same from what `samples_m` gave, without the time that it takes to make. Refuses what is
  /// not of these surfaces: another number of samples, or distances that are wrong wherever they
  /// are looked at (some hundred places are).
  static Result<DistanceField> restored(const TriangleMesh& mesh, const SurfaceIndex& near,
                                        const SurfaceIndex& bone, double cell_m, double margin_m,
                                        std::vector<float> samples_m);
  /// At the corners of the cells, x running fastest.
  [[nodiscard]] std::span<const float> samples_m() const { return distance_m_; }

  struct Value {
    double distance_m = 0.0;
    Vec3 gradient;  ///< about a unit vector
  };
  /// False outside the grid, which is farther than the margin from the surface.
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
