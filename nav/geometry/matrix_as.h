#pragma once

#include <cstddef>

#include "base/vec.h"

namespace orthonav::nav {

/// Copies into another library's 3×3 matrix, whose type stays out of this header. `out(r, c)` is
/// one of its entries.
template <class Matrix3>
[[nodiscard]] Matrix3 matrix_as(const Mat3& m) {
  Matrix3 out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      out(r, c) = m.m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    }
  }
  return out;
}

}  // namespace orthonav::nav
