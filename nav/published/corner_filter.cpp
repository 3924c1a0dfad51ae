#include "nav/published/corner_filter.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav::published {
namespace {

/// SD of the velocity of a newly visible tag, px/s.
constexpr double kFirstVelocity_px_per_s = 400.0;
constexpr double kCoordinates = 8.0;
// A tag that has moved farther than its own extent from the prediction is a new sighting.
constexpr double kJumpOfExtent = 1.0;

double extent_px(const CornerFilter::Corners& corners) {
  return std::max((corners[0] - corners[2]).norm(), (corners[1] - corners[3]).norm());
}

double squared_distance(const CornerFilter::Corners& a, const CornerFilter::Corners& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]).dot(a[i] - b[i]);
  }
  return sum;
}

}  // namespace

void CornerFilter::start(const Corners& measured_px, Timestamp time) {
  alive_ = true;
  time_ = time;
  position_px_ = measured_px;
  velocity_px_ = {};
  position_variance_ = options_.noise_px * options_.noise_px;
  covariance_ = 0.0;
  velocity_variance_ = kFirstVelocity_px_per_s * kFirstVelocity_px_per_s;
}

void CornerFilter::advance(double dt_s) {
  for (std::size_t i = 0; i < position_px_.size(); ++i) {
    position_px_[i] = position_px_[i] + dt_s * velocity_px_[i];
  }
  const double q = options_.acceleration_px2_per_s3;
  position_variance_ +=
      2.0 * dt_s * covariance_ + dt_s * dt_s * velocity_variance_ + q * dt_s * dt_s * dt_s / 3.0;
  covariance_ += dt_s * velocity_variance_ + q * dt_s * dt_s / 2.0;
  velocity_variance_ += q * dt_s;
}

void CornerFilter::correct(const Corners& measured_px) {
  const double noise = options_.noise_px * options_.noise_px;
  const double total = position_variance_ + noise;
  const double gain = position_variance_ / total;
  const double velocity_gain = covariance_ / total;
  for (std::size_t i = 0; i < position_px_.size(); ++i) {
    const Vec2 surprise = measured_px[i] - position_px_[i];
    position_px_[i] = position_px_[i] + gain * surprise;
    velocity_px_[i] = velocity_px_[i] + velocity_gain * surprise;
  }
  velocity_variance_ -= velocity_gain * covariance_;
  covariance_ *= 1.0 - gain;
  position_variance_ *= 1.0 - gain;
}

void CornerFilter::update(const Corners& measured_px, Timestamp time) {
  if (!alive_ || time <= time_) {
    return start(measured_px, time);
  }
  const Prediction expected = predicted(time);
  const double moved_px =
      std::sqrt(squared_distance(measured_px, expected.corners_px) / kCoordinates * 2.0);
  if (moved_px > kJumpOfExtent * extent_px(measured_px)) {
    return start(measured_px, time);
  }
  advance(seconds(time - time_));
  time_ = time;
  correct(measured_px);
}

CornerFilter::Prediction CornerFilter::predicted(Timestamp time) const {
  CornerFilter ahead = *this;
  ahead.advance(std::max(0.0, seconds(time - time_)));
  return {ahead.position_px_, std::sqrt(ahead.position_variance_)};
}

}  // namespace orthonav::nav::published
