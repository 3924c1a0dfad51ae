#pragma once

#include <span>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::nav {

/// Centripetal Catmull-Rom spline through all points, from the first to the last (Yuksel et al.
/// 2011, "Parameterization and applications of Catmull-Rom curves", alpha = 0.5; the end tangents
/// come from reflected phantom points).
class CatmullRom {
 public:
  /// Refuses fewer than 2 points, non-finite ones and neighbours closer than 0.1 mm.
  static Result<CatmullRom> through(std::span<const Vec3> points_m);
  [[nodiscard]] std::size_t segments() const { return points_m_.size() - 3; }
  /// Position at `t` in [0, 1] of a segment.
  [[nodiscard]] Vec3 position(std::size_t segment, double t) const;
  /// Derivative by t there, metres.
  [[nodiscard]] Vec3 derivative(std::size_t segment, double t) const;
  /// Length to within 1 µm by adaptive Gauss-Legendre quadrature of |derivative|.
  [[nodiscard]] double length_m() const;
  [[nodiscard]] double segment_length_m(std::size_t segment) const;
  /// About `spacing_m` apart along the arc, both ends included.
  [[nodiscard]] std::vector<Vec3> sampled(double spacing_m) const;

 private:
  std::vector<Vec3> points_m_;  ///< with one phantom point at either end
};

}  // namespace orthonav::nav
