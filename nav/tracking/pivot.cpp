#include "nav/tracking/pivot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <Eigen/Dense>

namespace orthonav::nav {
namespace {

Eigen::Matrix3d as_eigen(const Mat3& m) {
  Eigen::Matrix3d out;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) out(r, c) = m[r][static_cast<std::size_t>(c)];
  return out;
}

Eigen::Vector3d as_eigen(Vec3 v) { return {v.x, v.y, v.z}; }

Error refused(const char* format, double value, double limit) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, value, limit);
  return Error{text.data()};
}

struct Means {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

Means means_of(std::span<const Transform<World, Marker>> poses) {
  Means mean;
  for (const auto& pose : poses) {
    mean.rotation += as_eigen(pose.rotation());
    mean.translation += as_eigen(pose.translation());
  }
  mean.rotation /= static_cast<double>(poses.size());
  mean.translation /= static_cast<double>(poses.size());
  return mean;
}

}  // namespace

Result<PivotCalibration> pivot_calibration(std::span<const Transform<World, Marker>> poses,
                                           const PivotOptions& options) {
  const auto count = static_cast<double>(poses.size());
  const std::size_t least = std::max<std::size_t>(options.min_poses, 3);
  if (poses.size() < least)
    return refused("pivot calibration: %.0f poses, at least %.0f are needed", count,
                   static_cast<double>(least));
  const Means mean = means_of(poses);
  if (!mean.rotation.allFinite() || !mean.translation.allFinite())
    return Error{"pivot calibration: a pose is not finite"};

  // The pivot is the mean of R·tip + t; without it, (R - mean R)·tip = -(t - mean t).
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& pose : poses) {
    const Eigen::Matrix3d turn = as_eigen(pose.rotation()) - mean.rotation;
    normal += turn.transpose() * turn;
    right -= turn.transpose() * (as_eigen(pose.translation()) - mean.translation);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  PivotCalibration result;
  result.spread_rad = std::sqrt(std::max(0.0, solver.eigenvalues()(0)) / count);
  if (!(result.spread_rad >= options.min_spread_rad))
    return refused("pivot calibration: the tool turned by %.3f rad RMS, at least %.3f is needed",
                   result.spread_rad, options.min_spread_rad);
  const Eigen::Vector3d tip = solver.eigenvectors() *
                              solver.eigenvalues().cwiseInverse().asDiagonal() *
                              solver.eigenvectors().transpose() * right;
  const Eigen::Vector3d pivot = mean.rotation * tip + mean.translation;
  double squared = 0.0;
  for (const auto& pose : poses)
    squared +=
        (as_eigen(pose.rotation()) * tip + as_eigen(pose.translation()) - pivot).squaredNorm();
  result.rmse_m = std::sqrt(squared / count);
  if (!(result.rmse_m <= options.max_rmse_m))
    return refused("pivot calibration: residual %.2f mm RMS, limit %.2f mm (did the tip slip?)",
                   result.rmse_m * 1e3, options.max_rmse_m * 1e3);
  // 3 n equations for 6 unknowns.
  const double variance = squared / (3.0 * count - 6.0);
  result.tip_sigma_m = std::sqrt(variance * solver.eigenvalues().cwiseInverse().sum());
  result.tip_in_marker = {{tip.x(), tip.y(), tip.z()}};
  result.pivot_in_world = {{pivot.x(), pivot.y(), pivot.z()}};
  return result;
}

}  // namespace orthonav::nav
