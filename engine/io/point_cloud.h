#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "base/vec.h"

namespace orthonav::engine {

/// Points on repeatedly measured surfaces: only the first point in each cube of space is kept.
class PointCloud {
 public:
  using Single = std::array<float, 3>;  ///< metres
  /// The cubes' side; 0: every point is kept.
  explicit PointCloud(double cell_m) : cell_m_(cell_m) {}
  void add(Vec3 point_m);
  [[nodiscard]] const std::vector<Single>& points_m() const { return points_m_; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };
  double cell_m_;
  std::vector<Single> points_m_;
  std::unordered_set<Cell, Hash> taken_;
};

}  // namespace orthonav::engine
