#include "nav/guidance/rod_bender.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/angle.h"
#include "base/printed.h"
#include "nav/guidance/rod.h"

namespace orthonav::nav {
namespace {

constexpr double kWidestTrial_rad = 120.0 * kRadiansPerDegree;
/// Halvings of 180°: the remainder is far below the resolution of a bender's scale.
constexpr int kHalvings = 60;

struct BenderRange {
  const char* name;
  double value;
  double least;
  double most;
  const char* unit;
};

Status check_bender_ranges(const RodBender& bender, const RodMaterial& material,
                           double diameter_m) {
  const std::array<BenderRange, 6> ranges = {
      {{"width of a bend", bender.width_m * 1e3, 2, 100, "mm"},
       {"die radius", bender.die_radius_m * 1e3, 1, 500, "mm"},
       {"rod diameter", diameter_m * 1e3, kThinnestRod_m * 1e3, kThickestRod_m * 1e3, "mm"},
       {"yield strength", material.yield_pa * 1e-6, 10, 3000, "MPa"},
       {"elastic modulus", material.modulus_pa * 1e-9, 1, 400, "GPa"},
       {"elongation", material.elongation * 100.0, 1, 60, "%"}}};
  for (const BenderRange& range : ranges) {
    if (!std::isfinite(range.value)) {
      return Error{printed("%s of the rod to bend is not finite", range.name)};
    }
    if (range.value < range.least || range.value > range.most) {
      const double limit = range.value < range.least ? range.least : range.most;
      return Error{printed("%s is %s %s, limit %g-%g %s", range.name,
                           value_beside(range.value, limit, 1).c_str(), range.unit, range.least,
                           range.most, range.unit)};
    }
  }
  return {};
}

Status check_trials(const std::vector<SpringBackTrial>& trials) {
  SpringBackTrial before;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const SpringBackTrial& trial = trials[i];
    const double set_deg = trial.set_rad * kDegreesPerRadian;
    const double kept_deg = trial.kept_rad * kDegreesPerRadian;
    if (!(std::isfinite(set_deg) && std::isfinite(kept_deg))) {
      return Error{printed("spring-back trial %zu is not finite", i + 1)};
    }
    if (trial.set_rad > kWidestTrial_rad) {
      return Error{printed("spring-back trial %zu is set to %.1f°, limit 120°", i + 1, set_deg)};
    }
    if (trial.kept_rad > trial.set_rad || trial.kept_rad < 0.0) {
      return Error{printed("spring-back trial %zu keeps %.1f°, limit 0-%.1f°, what was set", i + 1,
                           kept_deg, set_deg)};
    }
    // Only the first trial may keep no angle: it was elastic.
    if (trial.set_rad <= before.set_rad || (i > 0 && trial.kept_rad <= before.kept_rad)) {
      return Error{printed(
          "spring-back trial %zu of %.1f° that keeps %.1f° does not rise from the one before",
          i + 1, set_deg, kept_deg)};
    }
    before = trial;
  }
  if (!trials.empty() && trials.back().kept_rad <= 0.0) {
    return Error{"spring-back trials keep no bend at all"};
  }
  return {};
}

/// The moment, relative to that at first yield, of a round bar that is curved `over_yield` times as
/// much as at first yield and yields at a constant stress: it grows from π/32 σ d³ to 16/(3π) =
/// 1.70 times that.
double moment_over_yield(double over_yield) {
  if (over_yield <= 1.0) {
    return over_yield;
  }
  const double core = 1.0 / over_yield;
  return 2.0 / std::numbers::pi *
         ((5.0 - 2.0 * core * core) / 3.0 * std::sqrt(1.0 - core * core) + std::asin(core) / core);
}

}  // namespace

RodSpringBack::RodSpringBack(RodBender bender, RodMaterial material, double diameter_m)
    : bender_(bender), material_(std::move(material)), diameter_m_(diameter_m) {}

Result<RodSpringBack> RodSpringBack::of(const RodBender& bender, const RodMaterial& material,
                                        double diameter_m) {
  if (const Status s = check_bender_ranges(bender, material, diameter_m); !s) {
    return s.error();
  }
  if (const Status s = check_trials(material.trials); !s) {
    return s.error();
  }
  return RodSpringBack(bender, material, diameter_m);
}

double RodSpringBack::kept_rad(double set_rad) const {
  if (!material_.trials.empty()) {
    SpringBackTrial before;
    for (const SpringBackTrial& trial : material_.trials) {
      if (set_rad <= trial.set_rad) {
        const double part = (set_rad - before.set_rad) / (trial.set_rad - before.set_rad);
        return before.kept_rad + part * (trial.kept_rad - before.kept_rad);
      }
      before = trial;
    }
    // Beyond the trials, no additional spring-back is assumed.
    return before.kept_rad + set_rad - before.set_rad;
  }
  const double yield_rad =
      2.0 * material_.yield_pa / (material_.modulus_pa * diameter_m_) * bender_.width_m;
  return set_rad - yield_rad * moment_over_yield(set_rad / yield_rad);
}

double RodSpringBack::smallest_radius_m() const {
  return std::max(bender_.die_radius_m, 0.5 * diameter_m_ / material_.elongation);
}

double RodSpringBack::most_kept_rad() const {
  const double most_set_rad = bender_.width_m / smallest_radius_m();
  return kept_rad(material_.trials.empty()
                      ? most_set_rad
                      : std::min(most_set_rad, material_.trials.back().set_rad));
}

Result<double> RodSpringBack::set_rad(double kept_rad) const {
  if (!(kept_rad >= 0.0)) {
    return Error{printed("bend of %.1f°, must be 0° or more", kept_rad * kDegreesPerRadian)};
  }
  if (!material_.trials.empty() && kept_rad > material_.trials.back().kept_rad) {
    return Error{printed("bend of %s° lies beyond the spring-back trials of %s, limit %.1f°",
                         value_beside(kept_rad * kDegreesPerRadian,
                                      material_.trials.back().kept_rad * kDegreesPerRadian, 1)
                             .c_str(),
                         material_.name.c_str(),
                         material_.trials.back().kept_rad * kDegreesPerRadian)};
  }
  double low_rad = 0.0;
  double high_rad = std::numbers::pi;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_rad = 0.5 * (low_rad + high_rad);
    (this->kept_rad(middle_rad) < kept_rad ? low_rad : high_rad) = middle_rad;
  }
  const double radius_m = bender_.width_m / high_rad;
  // A micrometre of tolerance: bisection may miss a bend that is exactly the sharpest by that much.
  if (radius_m < smallest_radius_m() - 1e-6) {
    return Error{printed("bend of %.1f° has a radius of %s mm on the bender, limit %.1f mm",
                         kept_rad * kDegreesPerRadian,
                         value_beside(radius_m * 1e3, smallest_radius_m() * 1e3, 1).c_str(),
                         smallest_radius_m() * 1e3)};
  }
  return high_rad;
}

}  // namespace orthonav::nav
