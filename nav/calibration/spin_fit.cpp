#include "nav/calibration/spin_fit.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "base/angle.h"
#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using SpinPoses = std::span<const Transform<World, Marker>>;
using ChosenPoses = std::span<const std::size_t>;

// Less turning than this is rounding.
constexpr double kLeastSpread = 1e-6;

Eigen::Matrix3d mean_rotation(SpinPoses poses, ChosenPoses chosen) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const std::size_t i : chosen) {
    sum += matrix_as<Eigen::Matrix3d>(poses[i].rotation());
  }
  return sum / static_cast<double>(chosen.size());
}

}  // namespace

double SpinFit::miss_rad(const Transform<World, Marker>& pose) const {
  return angle_between_rad((pose * Direction<Marker>{axis_in_marker}).v, axis_in_world);
}

std::optional<SpinFit> fit_spin(SpinPoses poses, ChosenPoses chosen) {
  if (chosen.size() < 2) {
    return std::nullopt;
  }
  const Eigen::Matrix3d mean = mean_rotation(poses, chosen);
  if (!mean.allFinite()) {
    return std::nullopt;
  }
  // Eigenvalues in increasing order: squares of the singular values.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(mean.transpose() * mean);
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);
  const Eigen::Vector3d free = (Eigen::Vector3d::Ones() - solver.eigenvalues()).cwiseMax(0.0);
  SpinFit fit;
  fit.spread = std::sqrt(free(1));
  const Eigen::Vector3d in_world = mean * axis;
  if (!(fit.spread > kLeastSpread) || !(in_world.norm() > 0.0)) {
    return std::nullopt;
  }
  fit.axis_in_marker = vec_of(axis);
  fit.axis_in_world = vec_of(Eigen::Vector3d(in_world.normalized()));
  double squared = 0.0;
  for (const std::size_t i : chosen) {
    squared += fit.miss_rad(poses[i]) * fit.miss_rad(poses[i]);
  }
  const auto count = static_cast<double>(chosen.size());
  fit.wobble_rad = std::sqrt(squared / count);
  // Two numbers per pose, four unknowns; an error of the axis is visible in proportion to the
  // turning.
  const double variance = squared / std::max(1.0, 2.0 * count - 4.0);
  fit.axis_sigma_rad = std::sqrt(variance / count * (1.0 / free(0) + 1.0 / free(1)));
  return fit;
}

Vec3 beside_axis_m(SpinPoses poses, ChosenPoses chosen, const SpinFit& fit, Point<Marker> tip) {
  const auto count = static_cast<double>(chosen.size());
  const Eigen::Matrix3d mean = mean_rotation(poses, chosen);
  Eigen::Vector3d mean_tip = Eigen::Vector3d::Zero();
  for (const std::size_t i : chosen) {
    mean_tip += vector_as<Eigen::Vector3d>((poses[i] * tip).v) / count;
  }
  const Eigen::Vector3d along = vector_as<Eigen::Vector3d>(fit.axis_in_world);
  const Eigen::Vector3d axis = vector_as<Eigen::Vector3d>(fit.axis_in_marker);
  // The line passes tip + offset, which moves only along it: with the means taken off,
  // across · ((R - mean R) · offset + R·tip + t - mean) = 0, and the axis · offset = 0.
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
  Eigen::Matrix3d normal = count * axis * axis.transpose();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t i : chosen) {
    const Eigen::Matrix3d lever = across * (matrix_as<Eigen::Matrix3d>(poses[i].rotation()) - mean);
    normal += lever.transpose() * lever;
    right -= lever.transpose() * (vector_as<Eigen::Vector3d>((poses[i] * tip).v) - mean_tip);
  }
  return vec_of(Eigen::Vector3d(-normal.ldlt().solve(right)));
}

}  // namespace orthonav::nav
