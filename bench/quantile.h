#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace orthonav {

/// The value that `fraction` of the values lie at or below, without interpolation; 0 for none.
inline double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

}  // namespace orthonav
