#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace orthonav {

/// An interval of a share that was counted.
struct FractionInterval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's 95 % interval of `count` of `all`, which need not be whole numbers; 0 to 1 of none.
inline FractionInterval wilson(double count, std::size_t all) {
  if (all == 0) {
    return {};
  }
  constexpr double kZ = 1.96;
  const auto n = static_cast<double>(all);
  const double fraction = count / n;
  const double middle = (fraction + kZ * kZ / (2.0 * n)) / (1.0 + kZ * kZ / n);
  const double half = kZ / (1.0 + kZ * kZ / n) *
                      std::sqrt(fraction * (1.0 - fraction) / n + kZ * kZ / (4.0 * n * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace orthonav
