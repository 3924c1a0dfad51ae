#include "nav/registration/verdict.h"

namespace orthonav::nav {

std::vector<RefusalReason> reasons_against(const Registration& r,
                                           const PoseSearchRegistrationOptions& o) {
  using Kind = RefusalReason::Kind;
  std::vector<RefusalReason> reasons;
  // Negated comparisons, so that what is not a number refuses.
  const auto at_most = [&](Kind kind, double value, double limit) {
    if (!(value <= limit)) {
      reasons.push_back({kind, value, limit, {}, {}});
    }
  };
  const auto at_least = [&](Kind kind, double value, double limit) {
    if (!(value >= limit)) {
      reasons.push_back({kind, value, limit, {}, {}});
    }
  };
  at_most(Kind::kNoise, r.noise_m, o.max_noise_m);
  at_least(Kind::kInliers, r.inlier_fraction, o.min_inlier_fraction);
  at_least(Kind::kCoverage, r.coverage_fraction, o.min_coverage_fraction);
  at_most(Kind::kShaftCollision, r.shaft_collision_fraction, o.max_shaft_collision_fraction);
  at_least(Kind::kLogLikelihoodRatio, r.log_likelihood_ratio, o.min_log_likelihood_ratio);
  if (!(r.predicted_tre_m <= o.max_predicted_tre_m)) {
    reasons.push_back(
        {Kind::kTreAtScrews, r.predicted_tre_m, o.max_predicted_tre_m, r.weakest, {}});
  } else if (!(r.tre_95_m <= o.max_tre_95_m)) {
    reasons.push_back({Kind::kTre95AtScrews, r.tre_95_m, o.max_tre_95_m, r.weakest, {}});
  }
  if (!r.fits_better.empty()) {
    reasons.push_back({Kind::kFitsOtherLevel, 0.0, 0.0, {}, r.fits_better});
  }
  return reasons;
}

}  // namespace orthonav::nav
