#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/vec.h"

namespace orthonav::nav {

// The blocked jackknife (Kuensch 1989): errors of consecutive measurements are correlated, so whole
// stretches of them are left out in turn, not single ones.

inline constexpr std::size_t kJackknifeBlocks = 10;

/// The indices below `count` except those of one tenth; every index belongs to exactly one tenth.
[[nodiscard]] inline std::vector<std::size_t> without_block(std::size_t count, std::size_t block) {
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < count; ++i) {
    if (i * kJackknifeBlocks / count != block) {
      rest.push_back(i);
    }
  }
  return rest;
}

/// The SD of an estimate from its values without each tenth; for vectors, the 3-D SD. 0 for fewer
/// than two.
[[nodiscard]] inline double jackknife_sd(std::span<const Vec3> without_each) {
  const auto count = static_cast<double>(without_each.size());
  if (count < 2.0) {
    return 0.0;
  }
  Vec3 sum;
  for (const Vec3& value : without_each) {
    sum += value;
  }
  double squared = 0.0;
  for (const Vec3& value : without_each) {
    squared += (value - sum / count).squared_norm();
  }
  return std::sqrt((count - 1.0) / count * squared);
}

}  // namespace orthonav::nav
