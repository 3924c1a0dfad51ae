#pragma once

#include <array>

namespace orthonav::nav {

/// Eigenvalues of a symmetric matrix in ascending order, and their unit eigenvectors, stored one
/// after the other.
struct SymmetricEigen6 {
  std::array<double, 6> values{};
  std::array<double, 36> vectors{};
};

/// `matrix`: 6×6, symmetric. Kept in one source file because Eigen's decomposition is slow to
/// compile.
[[nodiscard]] SymmetricEigen6 symmetric_eigen(const std::array<double, 36>& matrix);

}  // namespace orthonav::nav
