#include "nav/statistics/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace orthonav::nav {

SymmetricEigen6 symmetric_eigen(const std::array<double, 36>& matrix) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(
      Eigen::Map<const Matrix6>(matrix.data()).eval());
  SymmetricEigen6 out;
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(out.values.data()) = solver.eigenvalues();
  Eigen::Map<Matrix6>(out.vectors.data()) = solver.eigenvectors();
  return out;
}

}  // namespace orthonav::nav
