#include "hal/sim/room/spine_motion.h"

#include <algorithm>
#include <charconv>
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

double fraction_of_breath(std::string_view label) {
  constexpr double kGreatest_mm = 1.96;
  constexpr double kFirstLumbar = 1.6 / kGreatest_mm;
  constexpr double kLastLumbar = 1.3 / kGreatest_mm;
  int number = 0;
  if (label.size() < 2 ||
      std::from_chars(label.data() + 1, label.data() + label.size(), number).ec != std::errc{}) {
    return 1.0;
  }
  switch (label.front()) {
    case 'T':
      return 1.0 - 0.4 * std::clamp((10.0 - number) / 9.0, 0.0, 1.0);
    case 'L':
      return kFirstLumbar +
             (kLastLumbar - kFirstLumbar) * std::clamp((number - 1.0) / 4.0, 0.0, 1.0);
    case 'S':
      return 0.5;
    default:
      return 1.0;
  }
}

}  // namespace orthonav::sim
