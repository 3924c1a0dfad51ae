#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/vec.h"
#include "nav/geometry/implicit_surface.h"

namespace orthonav::nav {

/// Values at the nodes of a regular grid; a cell has the index of its lowest corner.
class SampleGrid {
 public:
  SampleGrid(const ImplicitFunction& function, Vec3 low, Vec3 high, double step)
      : low_(low), step_(step) {
    for (int axis = 0; axis < 3; ++axis) {
      size_[static_cast<std::size_t>(axis)] =
          static_cast<int>(std::ceil((high[axis] - low[axis]) / step)) + 1;
    }
    values_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                   static_cast<std::size_t>(size_[2]));
    for (int z = 0; z < size_[2]; z += kBlock) {
      for (int y = 0; y < size_[1]; y += kBlock) {
        for (int x = 0; x < size_[0]; x += kBlock) {
          fill_block(function, {x, y, z});
        }
      }
    }
  }
  [[nodiscard]] Vec3 position(const std::array<int, 3>& node) const {
    return low_ + step_ * Vec3{double(node[0]), double(node[1]), double(node[2])};
  }
  [[nodiscard]] std::size_t index(const std::array<int, 3>& node) const {
    return (static_cast<std::size_t>(node[2]) * static_cast<std::size_t>(size_[1]) +
            static_cast<std::size_t>(node[1])) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(node[0]);
  }
  [[nodiscard]] double value(const std::array<int, 3>& node) const { return values_[index(node)]; }
  [[nodiscard]] bool inside(const std::array<int, 3>& node) const { return value(node) < 0.0; }
  [[nodiscard]] int size(std::size_t axis) const { return size_[axis]; }
  [[nodiscard]] std::size_t nodes() const { return values_.size(); }

 private:
  /// Far from the surface one value is used for a whole block.
  void fill_block(const ImplicitFunction& function, const std::array<int, 3>& first) {
    const double half = 0.5 * kBlock * step_;
    const double middle = function(position(first) + Vec3{half, half, half});
    const bool far = std::abs(middle) > kFarInHalfDiagonals * std::sqrt(3.0) * half;
    for (int z = first[2]; z < std::min(first[2] + kBlock, size_[2]); ++z) {
      for (int y = first[1]; y < std::min(first[1] + kBlock, size_[1]); ++y) {
        for (int x = first[0]; x < std::min(first[0] + kBlock, size_[0]); ++x) {
          values_[index({x, y, z})] = far ? middle : function(position({x, y, z}));
        }
      }
    }
  }
  static constexpr int kBlock = 4;
  static constexpr double kFarInHalfDiagonals = 2.0;

  Vec3 low_;
  double step_;
  std::array<int, 3> size_{};
  std::vector<double> values_;
};

}  // namespace orthonav::nav
