#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace orthonav {

/// The value that a `fraction` of the values does not exceed, without interpolation; 0 if there are
/// none.
inline double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

}  // namespace orthonav
