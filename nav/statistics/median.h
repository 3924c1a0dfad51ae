#pragma once

#include <algorithm>
#include <vector>

namespace orthonav::nav {

/// The value in the middle; of an even count the larger of the two there, so that it is always one
/// of the values. `values` must not be empty and hold no NaN.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace orthonav::nav
