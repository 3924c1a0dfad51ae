#include "nav/registration/verdict.h"

#include <utility>

#include "base/findings.h"

namespace orthonav::nav {
std::vector<std::string> reasons_against(const Registration& r,
                                         const PoseSearchRegistrationOptions& o) {
  std::vector<std::string> reasons;
  const std::string weakest = r.weakest.empty() ? "" : ": " + r.weakest;
  const auto refuse = [&](std::string reason) { reasons.push_back(std::move(reason)); };
  if (!(r.noise_m <= o.max_noise_m)) {
    refuse(with_numbers("the points scatter %.1f mm about the surface, limit %.1f mm",
                        r.noise_m * 1e3, o.max_noise_m * 1e3));
  }
  if (!(r.inlier_fraction >= o.min_inlier_fraction)) {
    refuse(with_numbers("only %.0f %% of the points lie on the model, at least %.0f %%",
                        r.inlier_fraction * 100.0, o.min_inlier_fraction * 100.0));
  }
  if (!(r.coverage_fraction >= o.min_coverage_fraction)) {
    refuse(with_numbers("only %.0f %% of the surface was stroked, at least %.0f %%",
                        r.coverage_fraction * 100.0, o.min_coverage_fraction * 100.0));
  }
  if (!(r.shaft_collision_fraction <= o.max_shaft_collision_fraction)) {
    refuse(with_numbers(
        "the pointer would have gone through bone at %.0f %% of the points, limit %.0f %%",
        r.shaft_collision_fraction * 100.0, o.max_shaft_collision_fraction * 100.0));
  }
  if (!(r.log_likelihood_ratio >= o.min_log_likelihood_ratio)) {
    refuse(with_numbers("another pose fits nearly as well (margin %.1f, at least %.0f)",
                        r.log_likelihood_ratio, o.min_log_likelihood_ratio));
  }
  if (!(r.predicted_tre_m <= o.max_predicted_tre_m)) {
    refuse(with_numbers("error expected at the screws %.1f mm, limit %.1f mm",
                        r.predicted_tre_m * 1e3, o.max_predicted_tre_m * 1e3) +
           weakest);
  } else if (!(r.tre_95_m <= o.max_tre_95_m)) {
    refuse(with_numbers("1 of 20 errors at the screws would exceed %.1f mm, limit %.1f mm",
                        r.tre_95_m * 1e3, o.max_tre_95_m * 1e3) +
           weakest);
  }
  if (!r.fits_better.empty()) {
    refuse("the points fit level " + r.fits_better + " as well");
  }
  return reasons;
}

}  // namespace orthonav::nav
