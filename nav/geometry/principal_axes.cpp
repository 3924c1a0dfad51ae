#include "nav/geometry/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

/// Eigenvectors come with either sign; the largest component is made positive.
Vec3 signed_axis(const Eigen::Vector3d& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  return v(largest) < 0.0 ? -vec_of(v) : vec_of(v);
}

}  // namespace

PrincipalAxes principal_axes(std::span<const Vec3> points_m, std::span<const double> weights) {
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  PrincipalAxes result;
  double total = 0.0;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    result.centre_m += weight(i) * points_m[i];
    total += weight(i);
  }
  result.centre_m = result.centre_m / total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const auto d = vector_as<Eigen::Vector3d>(points_m[i] - result.centre_m);
    covariance += weight(i) * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance / total);
  for (int k = 0; k < 3; ++k) {  // Eigen sorts from least to greatest
    const auto i = static_cast<std::size_t>(k);
    result.axes[i] = signed_axis(solver.eigenvectors().col(2 - k));
    result.deviation_m[i] = std::sqrt(std::max(0.0, solver.eigenvalues()[2 - k]));
  }
  result.axes[2] = result.axes[0].cross(result.axes[1]);
  return result;
}

}  // namespace orthonav::nav
