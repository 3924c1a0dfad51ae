#include "bench/predicted_coverage.h"

#include <algorithm>
#include <Eigen/Dense>
#include <vector>

#include "base/random.h"

namespace orthonav::bench {
namespace {

/// Standard normal vectors, the same in every run.
const std::vector<Vec3>& draws() {
  static const std::vector<Vec3> kDraws = [] {
    constexpr int kCount = 4000;
    Random random(1);
    std::vector<Vec3> drawn;
    for (int i = 0; i < kCount; ++i) {
      const double x = random.normal();
      const double y = random.normal();
      drawn.push_back({x, y, random.normal()});
    }
    return drawn;
  }();
  return kDraws;
}

}  // namespace

PredictedCoverage::PredictedCoverage(const Mat3& covariance_m2) {
  Eigen::Matrix3d c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      c(i, j) = covariance_m2[i][j];
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(c);
  for (int i = 0; i < 3; ++i) {
    variances_m2_[i] = solver.eigenvalues()[i];
    for (int j = 0; j < 3; ++j) {
      axes_[j][i] = solver.eigenvectors()(j, i);
    }
  }
}

bool PredictedCoverage::in_ellipsoid(Vec3 error_m, double fraction) const {
  // Quantiles of the chi-squared distribution with three degrees of freedom.
  const double limit = fraction < 0.8 ? 3.5059 : 7.8147;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double along_m = axes_.column(static_cast<std::size_t>(i)).dot(error_m);
    sum += along_m * along_m / variances_m2_[i];
  }
  return sum <= limit;
}

bool PredictedCoverage::no_longer(Vec3 error_m, double fraction) const {
  const double length_m2 = error_m.squared_norm();
  const auto& all = draws();
  const auto shorter = std::count_if(all.begin(), all.end(), [&](Vec3 d) {
    return d.x * d.x * variances_m2_.x + d.y * d.y * variances_m2_.y + d.z * d.z * variances_m2_.z <
           length_m2;
  });
  return static_cast<double>(shorter) <= fraction * static_cast<double>(all.size());
}

}  // namespace orthonav::bench
