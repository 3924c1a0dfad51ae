#include "nav/registration/prior.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"

namespace orthonav::nav::posterior {

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double log_density_of_standoff(const Prior& prior, double s_m) {
  // The integral of half-normal densities over the logarithm of their scale.
  const double bare = s_m / prior.bare_m;
  const double tissue = s_m / prior.tissue_m;
  constexpr double kNearZero = 1e-6;
  const double density_m = bare > kNearZero ? 2.0 * (normal_cdf(-tissue) - normal_cdf(-bare)) / s_m
                                            : std::sqrt(2.0 / std::numbers::pi) *
                                                  (1.0 / prior.bare_m - 1.0 / prior.tissue_m);
  return std::log(density_m / std::log(prior.tissue_m / prior.bare_m));
}

double varies_by_less(const Prior& prior, double sd_m, double s_m) {
  return normal_cdf(std::log(sd_m / (prior.unevenness * std::max(s_m, 1e-9))) /
                    prior.unevenness_log_sd);
}

double model_off_by_less(const Prior& prior, double sd_m) {
  const auto of_any = [&](double sd) {
    if (sd < prior.exact_m) {
      return prior.exact_share * sd / prior.exact_m;
    }
    const double above = std::log(sd / prior.exact_m) / std::log(prior.worst_m / prior.exact_m);
    return std::min(1.0, prior.exact_share + (1.0 - prior.exact_share) * above);
  };
  const double less = of_any(prior.least_off_m);
  return less < 1.0                 ? std::max(0.0, of_any(sd_m) - less) / (1.0 - less)
         : sd_m < prior.least_off_m ? 0.0
                                    : 1.0;
}

double log_density_of_noise(const Prior& prior, double noise_m) {
  const double z = std::log(noise_m / prior.noise_m) / prior.noise_log_sd;
  return -0.5 * z * z - std::log(prior.noise_log_sd * std::sqrt(2.0 * std::numbers::pi));
}

double scatter_exceeded_m(const Prior& prior, double probability) {
  constexpr int kDraws = 4096;
  Random random(7);
  std::vector<double> spreads_m;
  for (int k = 0; k < kDraws; ++k) {
    const double scale_m = prior.bare_m * std::pow(prior.tissue_m / prior.bare_m, random.uniform());
    const double s_m = std::abs(random.normal(0.0, scale_m));
    // What is nowhere less than nothing varies by no more than its mean, about. The grid goes on
    // beyond: there that costs some evidence, here it would raise the limit.
    const auto uneven = [&] {
      return std::min(1.0,
                      prior.unevenness * std::exp(random.normal(0.0, prior.unevenness_log_sd))) *
             s_m;
    };
    const double tissue_m = uneven();
    const double stroke_m = random.uniform() < prior.uneven_hand_share ? uneven() : 0.0;
    const double share = random.uniform();
    const double model_m =
        share < prior.exact_share
            ? prior.exact_m * share / prior.exact_share
            : prior.exact_m * std::pow(prior.worst_m / prior.exact_m,
                                       (share - prior.exact_share) / (1.0 - prior.exact_share));
    const double noise_m = prior.noise_m * std::exp(random.normal(0.0, prior.noise_log_sd));
    const double all_m2 =
        tissue_m * tissue_m + stroke_m * stroke_m + model_m * model_m + noise_m * noise_m;
    spreads_m.push_back(std::sqrt(all_m2));
  }
  const auto at = spreads_m.end() - 1 - static_cast<std::ptrdiff_t>(probability * kDraws);
  std::nth_element(spreads_m.begin(), at, spreads_m.end());
  return *at;
}

}  // namespace orthonav::nav::posterior
