#include "nav/registration/press_covariance.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

namespace orthonav::nav {
namespace {

using Pose6 = Eigen::Matrix<double, 6, 1>;
using Covariance6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Rows6 = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Correlation length of soft tissue under a pressed tip.
constexpr double kSameTissue_m = 0.003;

Pose6 slope_about(Vec3 centre_m, const PressedHeight& at) {
  const Vec3 by_rotation = (at.at_m - centre_m).cross(at.up);
  Pose6 j;
  j << at.up.x, at.up.y, at.up.z, by_rotation.x, by_rotation.y, by_rotation.z;
  return j;
}

}  // namespace

std::array<double, 6> PressCovariance::slope(const PressedHeight& at) const {
  std::array<double, 6> out{};
  Eigen::Map<Pose6>(out.data()) = slope_about(centre_m, at);
  return out;
}

std::array<double, 6> PressCovariance::with_pose(const PressedHeight& at) const {
  const Covariance6 prior = Eigen::Map<const Covariance6>(before.data());
  Pose6 shared = prior * slope_about(centre_m, at);
  const double walk_m2 = press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * at.time_s;
  shared.head<3>() += walk_m2 * Eigen::Vector3d(at.up.x, at.up.y, at.up.z);
  std::array<double, 6> out{};
  Eigen::Map<Pose6>(out.data()) = shared;
  return out;
}

double PressCovariance::between_m2(const PressedHeight& a, const PressedHeight& b) const {
  const Covariance6 prior = Eigen::Map<const Covariance6>(before.data());
  const double walk_m2 =
      press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * std::min(a.time_s, b.time_s);
  // A second press over the same tissue has the same error as the first.
  const double tissue = std::exp(-(a.at_m - b.at_m).norm() / kSameTissue_m);
  return slope_about(centre_m, a).dot(prior * slope_about(centre_m, b)) + walk_m2 * a.up.dot(b.up) +
         press.common_sd_m * press.common_sd_m + press.sd_m * press.sd_m * tissue;
}

std::array<double, 36> PressCovariance::walked(double time_s) const {
  std::array<double, 36> out = before;
  Eigen::Map<Covariance6>(out.data()).topLeftCorner<3, 3>().diagonal().array() +=
      press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * time_s;
  return out;
}

std::array<double, 36> PressFit::with(const PressedHeight& next, const PressModel& press) const {
  const PressCovariance prior{before, centre_m, press};
  const auto n = static_cast<Eigen::Index>(heights.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(inverse_1_m2.data(), n, n);
  const std::array<double, 6> with_pose = prior.with_pose(next);
  Pose6 gain = Eigen::Map<const Pose6>(with_pose.data());
  double variance_m2 =
      prior.between_m2(next, next) + next.sd_m * next.sd_m + likeliest.sd_m * likeliest.sd_m;
  if (n > 0) {
    Eigen::VectorXd with_others(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const PressedHeight& other = heights[static_cast<std::size_t>(i)];
      with_others(i) =
          prior.between_m2(next, other) + shared_error_m2(likeliest, next.at_m, other.at_m);
    }
    const Eigen::VectorXd weighed = inverse * with_others;
    gain -= Eigen::Map<const Rows6>(shared.front().data(), n, 6).transpose() * weighed;
    variance_m2 -= with_others.dot(weighed);
  }
  std::array<double, 36> after{};
  Eigen::Map<Covariance6>(after.data()) =
      Eigen::Map<const Covariance6>(likeliest_covariance.data()) -
      gain * gain.transpose() / variance_m2;
  return after;
}

}  // namespace orthonav::nav
