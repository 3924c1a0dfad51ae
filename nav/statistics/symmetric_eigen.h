#pragma once

#include <array>

namespace orthonav::nav {

/// Of a symmetric matrix: its eigenvalues, the smallest first, and the unit vectors that belong to
/// them, one after the other.
struct SymmetricEigen6 {
  std::array<double, 6> values{};
  std::array<double, 36> vectors{};
};

/// `matrix`: 6×6; its lower triangle by columns is read. Compiled once for all that need it: the
/// decomposition is slow to compile.
[[nodiscard]] SymmetricEigen6 symmetric_eigen(const std::array<double, 36>& matrix);

}  // namespace orthonav::nav
