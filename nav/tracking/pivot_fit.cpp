#include "nav/tracking/pivot_fit.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using Poses = std::span<const Transform<World, Marker>>;
using Chosen = std::span<const std::size_t>;

// So small a rotation does not determine the tip.
constexpr double kLeastSpreadRad = 1e-6;

struct Means {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

Means means_of(Poses poses, Chosen chosen) {
  Means mean;
  for (const std::size_t i : chosen) {
    mean.rotation += matrix_as<Eigen::Matrix3d>(poses[i].rotation());
    mean.translation += vector_as<Eigen::Vector3d>(poses[i].translation());
  }
  mean.rotation /= static_cast<double>(chosen.size());
  mean.translation /= static_cast<double>(chosen.size());
  return mean;
}

}  // namespace

std::optional<PivotFit> fit_pivot(Poses poses, Chosen chosen) {
  if (chosen.size() < 3) {
    return std::nullopt;
  }
  const auto count = static_cast<double>(chosen.size());
  const Means mean = means_of(poses, chosen);
  if (!mean.rotation.allFinite() || !mean.translation.allFinite()) {
    return std::nullopt;
  }
  // The pivot is the mean of R·tip + t; without it, (R - mean R)·tip = -(t - mean t).
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t i : chosen) {
    const Eigen::Matrix3d deviation =
        matrix_as<Eigen::Matrix3d>(poses[i].rotation()) - mean.rotation;
    normal += deviation.transpose() * deviation;
    right -= deviation.transpose() *
             (vector_as<Eigen::Vector3d>(poses[i].translation()) - mean.translation);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
  PivotFit fit;
  fit.spread_rad = std::sqrt(std::max(0.0, solver.eigenvalues()(0)) / count);
  if (!(fit.spread_rad > kLeastSpreadRad)) {
    return std::nullopt;
  }
  const Eigen::Vector3d inverse = solver.eigenvalues().cwiseInverse();
  const Eigen::Vector3d tip =
      solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose() * right;
  fit.tip_in_marker = {vec_of(tip)};
  fit.pivot_in_world = {vec_of(Eigen::Vector3d(mean.rotation * tip + mean.translation))};
  double squared = 0.0;
  for (const std::size_t i : chosen) {
    squared += fit.miss_m(poses[i]) * fit.miss_m(poses[i]);
  }
  fit.rmse_m = std::sqrt(squared / count);
  return fit;
}

}  // namespace orthonav::nav
