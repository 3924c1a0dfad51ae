#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "nav/statistics/median.h"

namespace orthonav::nav {

// Cauchy's loss for the lengths of residuals of two normal coordinates; 95 % efficient if all are
// normal (Holland & Welsch 1977).

inline constexpr double kCauchyConstant = 2.385;

/// The SD of one coordinate from the median length, which is 1.1774 SDs; at least 0.02 px, since
/// smaller residuals come from interpolation, not from noise. `lengths_px` must not be empty.
[[nodiscard]] inline double cauchy_scale(std::vector<double> lengths_px) {
  return std::max(0.02, median(std::move(lengths_px)) / 1.1774);
}

[[nodiscard]] inline double cauchy_weight(double length_px, double scale_px) {
  const double u = length_px / (kCauchyConstant * scale_px);
  return 1.0 / (1.0 + u * u);
}

[[nodiscard]] inline double cauchy_cost(const std::vector<double>& lengths_px, double scale_px) {
  double sum = 0.0;
  for (const double length_px : lengths_px) {
    sum -= std::log(cauchy_weight(length_px, scale_px));
  }
  return sum;
}

}  // namespace orthonav::nav
