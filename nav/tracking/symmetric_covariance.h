#pragma once

#include <cstddef>

#include "base/tracked.h"

namespace orthonav::nav {

/// Symmetrizes a 6×6 covariance that is symmetric up to rounding: the mean of it and its transpose.
/// `m(r, c)` is an entry, so that the matrix's type stays out of this header.
template <class Matrix6>
[[nodiscard]] PoseCovariance symmetrized(const Matrix6& m) {
  PoseCovariance out;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 6; ++c) {
      out[static_cast<std::size_t>(6 * r + c)] = 0.5 * (m(r, c) + m(c, r));
    }
  }
  return out;
}

}  // namespace orthonav::nav
