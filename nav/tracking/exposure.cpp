#include "nav/tracking/exposure.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kUsual_s = 0.005;
constexpr double kLongest_s = 0.030;
/// Forgetting factor: pairs of the last few seconds count.
constexpr double kForgetting = 0.99;
/// The weight of the prior for the usual exposure: that of one fast sighting (v² / 12 in px⁴/s⁴).
constexpr double kBelief = 2e6;
/// Pairs farther apart than this say nothing about speed.
constexpr Duration kLongestGap = std::chrono::milliseconds(120);

}  // namespace

void ExposureEstimator::add(const BlurSighting& sighting) {
  if (before_ && middle_ && before_->view == sighting.view && middle_->view == sighting.view &&
      sighting.time > before_->time && sighting.time - before_->time <= kLongestGap) {
    // The speed at the middle sighting, without the delay of a one-sided difference.
    const double dt = seconds(sighting.time - before_->time);
    const Vec2 speed = (1.0 / dt) * (sighting.centre_px - before_->centre_px);
    const Vec2 c = middle_->column_px;
    const Vec2 r = middle_->row_px;
    const double area = c.x * r.y - c.y * r.x;
    const double across = (speed.x * r.y - speed.y * r.x) / area;
    const double down = (c.x * speed.y - c.y * speed.x) / area;
    if (std::isfinite(across) && std::isfinite(down)) {
      add(middle_->blur_cells.x * middle_->blur_cells.x * c.dot(c), across * across * c.dot(c));
      add(middle_->blur_cells.y * middle_->blur_cells.y * r.dot(r), down * down * r.dot(r));
    }
  }
  before_ = middle_;
  middle_ = sighting;
}

void ExposureEstimator::add(double blur_px2, double speed_px2) {
  const double x = speed_px2 / 12.0;
  n_ = kForgetting * n_ + 1.0;
  x_ = kForgetting * x_ + x;
  y_ = kForgetting * y_ + blur_px2;
  xx_ = kForgetting * xx_ + x * x;
  xy_ = kForgetting * xy_ + x * blur_px2;
}

double ExposureEstimator::exposure_s() const {
  if (!(n_ > 0.0)) {
    return kUsual_s;
  }
  const double spread = xx_ - x_ * x_ / n_;
  const double both = xy_ - x_ * y_ / n_;
  const double squared = (both + kBelief * kUsual_s * kUsual_s) / (spread + kBelief);
  return std::clamp(std::sqrt(std::max(0.0, squared)), 0.0, kLongest_s);
}

}  // namespace orthonav::nav
