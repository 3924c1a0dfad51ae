#pragma once

#include <algorithm>
#include <vector>

namespace orthonav::nav {

/// The middle value; with an even count the larger of the two middle ones, so that it is always one
/// of the values. `values` must not be empty nor hold NaN.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace orthonav::nav
