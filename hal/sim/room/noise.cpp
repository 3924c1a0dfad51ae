#include "hal/sim/room/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orthonav::sim {

SmoothNoise::SmoothNoise(Random random, double sd, double lowest, double highest)
    : amplitude_(sd * std::sqrt(2.0 / static_cast<double>(kWaves))) {
  for (std::size_t i = 0; i < kWaves; ++i) {
    const double slice = (static_cast<double>(i) + random.uniform()) / static_cast<double>(kWaves);
    rate_[i] = 2.0 * std::numbers::pi * (lowest + (highest - lowest) * slice);
    phase_[i] = 2.0 * std::numbers::pi * random.uniform();
  }
}

double SmoothNoise::at(double x) const {
  if (amplitude_ == 0.0) {
    return 0.0;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kWaves; ++i) {
    sum += std::sin(rate_[i] * x + phase_[i]);
  }
  return amplitude_ * sum;
}

SmoothNoise3::SmoothNoise3(const Random& random, double sd, double lowest, double highest) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i] = SmoothNoise(random.fork(i), sd, lowest, highest);
  }
}

Vec3 SmoothNoise3::at(double x) const { return {axes_[0].at(x), axes_[1].at(x), axes_[2].at(x)}; }

Vec3 normal_vector(Random& random, double sd) {
  const double x = random.normal();
  const double y = random.normal();
  const double z = random.normal();
  return sd * Vec3{x, y, z};
}

MapDrift::MapDrift(Random random, double m_per_sqrt_s, double rad_per_sqrt_s, double length_s,
                   const MapSteps& steps) {
  Random jumps = random.fork("steps");
  nodes_.resize(static_cast<std::size_t>(std::max(length_s, 0.0)) + 3);
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    nodes_[i].translation_m = nodes_[i - 1].translation_m + normal_vector(random, m_per_sqrt_s);
    nodes_[i].rotation_rad = nodes_[i - 1].rotation_rad + normal_vector(random, rad_per_sqrt_s);
    if (jumps.uniform() < steps.per_min / 60.0) {
      nodes_[i].translation_m += normal_vector(jumps, steps.sd_m);
    }
  }
}

MapDrift::Offset MapDrift::at(double time_s) const {
  const double last = static_cast<double>(nodes_.size() - 1);
  const double clamped = std::clamp(time_s, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(clamped), nodes_.size() - 2);
  const double fraction = clamped - static_cast<double>(i);
  const Offset& a = nodes_[i];
  const Offset& b = nodes_[i + 1];
  return {a.translation_m + fraction * (b.translation_m - a.translation_m),
          a.rotation_rad + fraction * (b.rotation_rad - a.rotation_rad)};
}

}  // namespace orthonav::sim
