#include "nav/tracking/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix12 = Eigen::Matrix<double, 12, 12, Eigen::RowMajor>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

/// Densities of the white acceleration of a tool at rest (m²/s³, rad²/s³): so small that the
/// pairs of a whole second are averaged.
constexpr double kRest_m = 2e-8;
constexpr double kRest_rad = 2e-7;
/// Those of a tool in a hand: 5 m/s² and 60 rad/s² held for 0.05 s.
constexpr double kHand_m = 1.25;
constexpr double kHand_rad = 180.0;
/// A pair whose innovation exceeds this (squared, normalised, 6 degrees of freedom: 1 in 2,000 at
/// rest) shows that the tool is in a hand.
constexpr double kRestLimit = 24.0;
/// The part of a measurement's variance that repeats in the next one: errors outside the model
/// must not be averaged away.
constexpr double kLastingFraction = 0.05;
/// SD of an unknown velocity.
constexpr double kFirstSpeed_m = 0.5;
constexpr double kFirstSpeed_rad = 3.0;

Eigen::Map<const Matrix12> as_eigen(const std::array<double, 144>& a) {
  return Eigen::Map<const Matrix12>(a.data());
}

Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> as_eigen(const PoseCovariance& a) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(a.data());
}

/// The difference between two poses: translation, and the rotation vector that is multiplied from
/// the left.
Vector6 difference(const PoseFilter::Pose& to, const PoseFilter::Pose& from) {
  const Vec3 translation = to.translation() - from.translation();
  const Vec3 rotation_vector = vector_from_rotation(to.rotation() * from.rotation().transposed());
  Vector6 out;
  out << translation.x, translation.y, translation.z, rotation_vector.x, rotation_vector.y,
      rotation_vector.z;
  return out;
}

/// A constant acceleration a moves the prediction by a dt² and the mean over an exposure T by a T²
/// / 24: this part of the innovation is not motion of the pose at mid-exposure.
double of_exposure(double exposure_s, double dt_s) { return std::pow(exposure_s / dt_s, 2) / 24.0; }

/// Subtracting it would help little, since the prediction has errors too, so it is added to the
/// covariance.
PoseCovariance blurred(const PoseCovariance& noise, const Vector6& innovation, double fraction) {
  PoseCovariance out = noise;
  for (std::size_t i = 0; i < 6; ++i) {
    out[7 * i] += std::pow(fraction * innovation(static_cast<int>(i)), 2);
  }
  return out;
}

double innovation(const Vector6& y, const Matrix12& p, const PoseCovariance& noise) {
  const Matrix6 s = p.topLeftCorner<6, 6>() + as_eigen(noise);
  return y.dot(s.ldlt().solve(y));
}

}  // namespace

PoseFilter::Covariance PoseFilter::grown(double dt, double density_m, double density_rad) const {
  Matrix12 p = as_eigen(covariance_);
  p.topRows<6>() += dt * p.bottomRows<6>();
  p.leftCols<6>() += dt * p.rightCols<6>();
  for (int i = 0; i < 6; ++i) {
    const double q = i < 3 ? density_m : density_rad;
    p(i, i) += q * dt * dt * dt / 3.0;
    p(i, i + 6) += q * dt * dt / 2.0;
    p(i + 6, i) += q * dt * dt / 2.0;
    p(i + 6, i + 6) += q * dt;
  }
  Covariance out;
  Eigen::Map<Matrix12>(out.data()) = p;
  return out;
}

Tracked<PoseFilter::Pose> PoseFilter::predicted(Timestamp time) const {
  const double dt = seconds(time - time_);
  // A tool at rest may be picked up at any moment.
  const Covariance p = grown(dt, kHand_m, kHand_rad);
  return {displaced(pose_, dt * velocity_m_, dt * velocity_rad_), time, PoseStatus::kPredicted,
          symmetrized(Matrix6(as_eigen(p).topLeftCorner<6, 6>()))};
}

void PoseFilter::start(const Tracked<Pose>& measured) {
  alive_ = true;
  time_ = measured.time;
  pose_ = measured.value;
  velocity_m_ = {};
  velocity_rad_ = {};
  Matrix12 p = Matrix12::Zero();
  p.topLeftCorner<6, 6>() = as_eigen(measured.covariance);
  for (int i = 6; i < 12; ++i) {
    p(i, i) = std::pow(i < 9 ? kFirstSpeed_m : kFirstSpeed_rad, 2);
  }
  Eigen::Map<Matrix12>(covariance_.data()) = p;
  lasting_ = measured.covariance;
}

void PoseFilter::update(const Tracked<Pose>& measured, double exposure_s) {
  const double dt = seconds(measured.time - time_);
  if (!alive_ || !(dt > 0.0)) {
    return start(measured);
  }
  const Pose ahead = displaced(pose_, dt * velocity_m_, dt * velocity_rad_);
  Vector6 y = difference(measured.value, ahead);
  Covariance grown_p = grown(dt, kRest_m, kRest_rad);
  const bool at_rest = innovation(y, as_eigen(grown_p), measured.covariance) < kRestLimit;
  if (!at_rest) {
    grown_p = grown(dt, kHand_m, kHand_rad);
  }
  const Matrix12 p = as_eigen(grown_p);
  const double fraction = of_exposure(exposure_s, dt);
  lasting_ = blurred(measured.covariance, y, fraction);
  y *= 1.0 - fraction;
  const Matrix6 noise = as_eigen(lasting_);
  const Matrix6 s = p.topLeftCorner<6, 6>() + noise;
  const Eigen::Matrix<double, 12, 6> gain = s.ldlt().solve(p.topRows<6>()).transpose();
  const Vector12 step = gain * y;
  pose_ = displaced(ahead, {step(0), step(1), step(2)}, {step(3), step(4), step(5)});
  velocity_m_ += {step(6), step(7), step(8)};
  velocity_rad_ += {step(9), step(10), step(11)};
  // Joseph's form, which rounding keeps symmetric and positive.
  Matrix12 rest = Matrix12::Identity();
  rest.leftCols<6>() -= gain;
  Eigen::Map<Matrix12>(covariance_.data()) =
      rest * p * rest.transpose() + gain * noise * gain.transpose();
  time_ = measured.time;
}

Tracked<PoseFilter::Pose> PoseFilter::state() const {
  // The filter treats errors as independent from pair to pair; this fraction of them is not.
  const Matrix6 p = as_eigen(covariance_).topLeftCorner<6, 6>();
  const Matrix6 r = as_eigen(lasting_);
  const double lasting = kLastingFraction;
  const double averaged = std::clamp(p.trace() / r.trace(), 0.0, 1.0);
  return {pose_, time_, PoseStatus::kMeasured,
          symmetrized(Matrix6(p + lasting * (1.0 - averaged) * r))};
}

}  // namespace orthonav::nav
