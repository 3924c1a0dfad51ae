#include "hal/sim/spine_motion.h"

#include <cmath>
#include <numbers>

namespace orthonav::sim {
namespace {

/// The patient lies prone along z; a breath lifts the back.
const Vec3 kWay = Vec3{0.0, 0.9, 0.4}.normalized();
/// The mean of the fourth power of a cosine.
constexpr double kMean = 3.0 / 8.0;

}  // namespace

SpineMotion::SpineMotion(Random random, const ErrorModel& error_model)
    : extent_m_(error_model.breathing_m),
      rate_hz_(error_model.breathing_hz),
      phase_(random.uniform()) {}

Vec3 SpineMotion::at(double time_s) const {
  if (extent_m_ == 0.0) {
    return {};
  }
  const double wave = std::cos(std::numbers::pi * (rate_hz_ * time_s + phase_));
  return extent_m_ * (std::pow(wave, 4) - kMean) * kWay;
}

}  // namespace orthonav::sim
