#include "nav/geometry/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

/// Eigenvectors come with either sign; the largest component is made positive.
Vec3 signed_axis(Vec3 v) {
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(v[i]) > std::abs(v[largest])) {
      largest = i;
    }
  }
  return v[largest] < 0.0 ? -v : v;
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
    const Vec3 d = points_m[i] - result.centre_m;
    const auto e = vector_as<Eigen::Vector3d>(d);
    covariance += weight(i) * e * e.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance / total);
  for (int k = 0; k < 3; ++k) {  // Eigen sorts from least to greatest
    const Eigen::Vector3d v = solver.eigenvectors().col(2 - k);
    const auto i = static_cast<std::size_t>(k);
    result.axes[i] = signed_axis({v.x(), v.y(), v.z()});
    result.deviation_m[i] = std::sqrt(std::max(0.0, solver.eigenvalues()[2 - k]));
  }
  result.axes[2] = result.axes[0].cross(result.axes[1]);
  return result;
}

}  // namespace orthonav::nav
