#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/angle.h"
#include "base/random.h"
#include "base/vec.h"

namespace orthonav::nav {

/// The heads of a lumbar spine, off its curve sideways and in depth.
inline std::vector<Vec3> uneven_seats(std::uint64_t seed, int count, double sideways_m = 0.002) {
  Random random(seed);
  std::vector<Vec3> seats;
  for (int i = 0; i < count; ++i) {
    const double a = 10.0 * kRadiansPerDegree * i;
    seats.push_back({random.normal(0.0, sideways_m),
                     -0.206 * std::cos(a) + random.normal(0.0, 0.001), 0.206 * std::sin(a)});
  }
  return seats;
}

}  // namespace orthonav::nav
