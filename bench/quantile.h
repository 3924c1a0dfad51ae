#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace orthonav {

/// The value that `share` of them lie below or at, without interpolation; 0 without any.
inline double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

}  // namespace orthonav
