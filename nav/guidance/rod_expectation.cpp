#include "nav/guidance/rod_expectation.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// Probability that a distance across the rod exceeds `left_m`: Rayleigh's, of two directions.
double beyond(double left_m, double variance_m2) {
  if (left_m <= 0.0) {
    return 1.0;
  }
  return variance_m2 > 0.0 ? std::exp(-0.5 * left_m * left_m / variance_m2) : 0.0;
}

}  // namespace

RodExpectation rod_expectation(const RodFit& fit, std::span<const double> seat_sd_m,
                               const RodExpectationRules& rules) {
  RodExpectation out{1.0, 0};
  const std::size_t seats = std::min(fit.seats.size(), seat_sd_m.size());
  const double left_over =
      seats > 2 ? static_cast<double>(seats - 2) / static_cast<double>(seats) : 0.0;
  double worst = -1.0;
  for (std::size_t i = 0; i < seats; ++i) {
    const double variance_m2 =
        seat_sd_m[i] * seat_sd_m[i] + rules.bending_sd_m * rules.bending_sd_m;
    const double missed = beyond(rules.limit_m - fit.seats[i].off_m, left_over * variance_m2);
    out.within *= 1.0 - missed;
    if (missed > worst) {
      worst = missed;
      out.least_sure = i;
    }
  }
  return out;
}

}  // namespace orthonav::nav
