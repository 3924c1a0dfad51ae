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
  // What a camera is off along its rays in a view, all places of the view are off alike; presses
  // have a height in common.
  const auto seen = [](const PressedHeight& h) { return h.ray.squared_norm() > 0.0; };
  double common_m2 = 0.0;
  if (seen(a) && seen(b) && a.view == b.view) {
    common_m2 = press.ray_sd_m * press.ray_sd_m * a.ray.dot(a.up) * b.ray.dot(b.up);
  } else if (!seen(a) && !seen(b)) {
    common_m2 = press.common_sd_m * press.common_sd_m;
  }
  return slope_about(centre_m, a).dot(prior * slope_about(centre_m, b)) + walk_m2 * a.up.dot(b.up) +
         common_m2 + press.sd_m * press.sd_m * tissue;
}

FieldCovariance::FieldCovariance(const ModelShare& strokes, double length_m, Vec3 centre_m)
    : strokes_(strokes), length_m_(length_m), centre_m_(centre_m) {
  Covariance6 sum = Covariance6::Zero();
  for (std::size_t i = 0; i < strokes.places_m.size(); ++i) {
    const std::array<double, 6> with = with_place(strokes.places_m[i]);
    sum += Eigen::Map<const Pose6>(with.data()) *
           Eigen::Map<const Pose6>(strokes.step[i].data()).transpose();
  }
  Eigen::Map<Covariance6>(pose_.data()) = 0.5 * (sum + sum.transpose());
}

std::array<double, 6> FieldCovariance::with_place(Vec3 at_m) const {
  const ModelError unit{1.0, length_m_};
  std::array<double, 6> out{};
  Eigen::Map<Pose6> sum(out.data());
  for (std::size_t i = 0; i < strokes_.places_m.size(); ++i) {
    sum += shared_error_m2(unit, strokes_.places_m[i], at_m) *
           Eigen::Map<const Pose6>(strokes_.step[i].data());
  }
  return out;
}

std::array<double, 6> FieldCovariance::with_pose(const PressedHeight& at,
                                                 const std::array<double, 6>& place) const {
  std::array<double, 6> out{};
  Eigen::Map<Pose6>(out.data()) =
      Eigen::Map<const Covariance6>(pose_.data()) * slope_about(centre_m_, at) -
      Eigen::Map<const Pose6>(place.data());
  return out;
}

double FieldCovariance::between(const PressedHeight& a, const std::array<double, 6>& place_a,
                                const PressedHeight& b,
                                const std::array<double, 6>& place_b) const {
  const Pose6 slope_a = slope_about(centre_m_, a);
  const Pose6 slope_b = slope_about(centre_m_, b);
  return slope_a.dot(Eigen::Map<const Covariance6>(pose_.data()) * slope_b) -
         slope_a.dot(Eigen::Map<const Pose6>(place_b.data())) -
         slope_b.dot(Eigen::Map<const Pose6>(place_a.data())) +
         shared_error_m2({1.0, length_m_}, a.at_m, b.at_m);
}

std::array<double, 36> PressCovariance::walked(double time_s) const {
  std::array<double, 36> out = before;
  Eigen::Map<Covariance6>(out.data()).topLeftCorner<3, 3>().diagonal().array() +=
      press.drift_m_per_sqrt_s * press.drift_m_per_sqrt_s * time_s;
  return out;
}

std::vector<std::array<double, 36>> PressFit::with(std::span<const PressedHeight> next,
                                                   const PressModel& press) const {
  const PressCovariance prior{before, centre_m, press};
  const FieldCovariance field(strokes, likeliest.length_m, centre_m);
  const double model_m2 = likeliest.sd_m * likeliest.sd_m;
  const auto n = static_cast<Eigen::Index>(heights.size());
  const Eigen::Map<const Eigen::MatrixXd> inverse(inverse_1_m2.data(), n, n);
  std::vector<std::array<double, 6>> places;
  for (const PressedHeight& other : heights) {
    places.push_back(field.with_place(other.at_m));
  }
  std::vector<std::array<double, 36>> out;
  for (const PressedHeight& one : next) {
    const std::array<double, 6> place = field.with_place(one.at_m);
    const std::array<double, 6> with_pose = prior.with_pose(one);
    const std::array<double, 6> by_field = field.with_pose(one, place);
    Pose6 gain = Eigen::Map<const Pose6>(with_pose.data()) +
                 model_m2 * Eigen::Map<const Pose6>(by_field.data());
    double variance_m2 = prior.between_m2(one, one) + one.sd_m * one.sd_m +
                         model_m2 * field.between(one, place, one, place);
    if (n > 0) {
      Eigen::VectorXd with_others(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        with_others(i) = prior.between_m2(one, heights[k]) +
                         model_m2 * field.between(one, place, heights[k], places[k]);
      }
      const Eigen::VectorXd weighed = inverse * with_others;
      gain -= Eigen::Map<const Rows6>(shared.front().data(), n, 6).transpose() * weighed;
      variance_m2 -= with_others.dot(weighed);
    }
    Eigen::Map<Covariance6>(out.emplace_back().data()) =
        Eigen::Map<const Covariance6>(likeliest_covariance.data()) -
        gain * gain.transpose() / variance_m2;
  }
  return out;
}

}  // namespace orthonav::nav
