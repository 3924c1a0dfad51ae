#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/vec.h"

namespace orthonav::nav {

/// The points of a cloud about their centre, ordered such that the first n, for any n, are spread
/// evenly over it, no matter how often a place was stroked.
class SpreadPoints {
 public:
  /// Leaves out points farther than `reach_m` from the middle.
  SpreadPoints(std::span<const Vec3> points_m, double reach_m);

  [[nodiscard]] Vec3 centre_m() const { return centre_m_; }
  [[nodiscard]] std::span<const Vec3> centred_m() const { return points_m_; }
  [[nodiscard]] std::span<const Vec3> first(std::size_t count) const {
    return std::span<const Vec3>(points_m_).first(std::min(count, points_m_.size()));
  }

 private:
  Vec3 centre_m_;
  std::vector<Vec3> points_m_;
};

}  // namespace orthonav::nav
