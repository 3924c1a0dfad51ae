#include "nav/registration/verdict.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

/// A smaller field can't be distinguished from a segmentation's own error.
constexpr double kUneven_m = 0.0003;
/// The scatter of points about the surface that is believed to be the hand's where the tip is at
/// the first height on average, and at the second one and higher.
constexpr double kLow_m = 0.0015;
constexpr double kHigh_m = 0.0025;
constexpr double kMaxScatterHigh_m = 0.0010;
/// A size counts as off from this many SDs.
constexpr double kCertainSds = 1.8;
/// Root mean square error at the screws above which a pose is not good enough for pressed places.
constexpr double kMaxProvisional_m = 0.004;

/// The most that the points may scatter with a tip that is so high above the bone on average. Soft
/// tissue so thick is uneven: such scatter is tissue, even if it looks like an unsteady hand.
double most_scatter_m(double standoff_m, double most_low_m) {
  const double high = std::clamp((standoff_m - kLow_m) / (kHigh_m - kLow_m), 0.0, 1.0);
  return std::lerp(most_low_m, std::min(most_low_m, kMaxScatterHigh_m), high);
}

/// What calls soft tissue by name, where something does; `refused` for other reasons already.
std::optional<RefusalReason> soft_tissue(const Registration& r, double max_noise_m, bool refused) {
  using Kind = RefusalReason::Kind;
  const double most_m = most_scatter_m(r.standoff_m, max_noise_m);
  if (r.noise_m > most_m && r.noise_m <= max_noise_m) {
    return RefusalReason{Kind::kSoftTissue, r.noise_m, most_m, {}, {}, r.stroke_next};
  }
  if (refused && r.field_sd_m > kUneven_m) {
    return RefusalReason{Kind::kSoftTissue, r.field_sd_m, kUneven_m, {}, {}, r.stroke_next};
  }
  return std::nullopt;
}

}  // namespace

std::vector<RefusalReason> reasons_against(const Registration& r,
                                           const PoseSearchRegistrationOptions& o) {
  using Kind = RefusalReason::Kind;
  std::vector<RefusalReason> reasons;
  // Negated comparisons, so that NaN is refused.
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
  if (const auto reason = error_at_screws(r, o)) {
    reasons.push_back(*reason);
  }
  if (const auto reason = soft_tissue(r, o.max_noise_m, !reasons.empty())) {
    reasons.push_back(*reason);
  }
  if (!(std::abs(r.size - 1.0) <= std::max(o.max_size_off, kCertainSds * r.size_sd))) {
    reasons.push_back({Kind::kModelSize, r.size, o.max_size_off, {}, {}, {}});
  }
  if (!(r.mirror_log_likelihood <= o.max_mirror_log_likelihood)) {
    reasons.push_back({Kind::kMirrored, r.mirror_log_likelihood, o.max_mirror_log_likelihood});
  }
  if (!r.fits_better.empty()) {
    reasons.push_back({Kind::kFitsOtherLevel, 0.0, 0.0, {}, r.fits_better});
  }
  // Strokes of another bone have other faults too: what they are comes first.
  for (const Kind first : {Kind::kMirrored, Kind::kFitsOtherLevel}) {
    std::stable_partition(reasons.begin(), reasons.end(),
                          [&](const RefusalReason& reason) { return reason.kind == first; });
  }
  return reasons;
}

std::vector<RefusalReason> reasons_against_any_bone(const Registration& r,
                                                    const PoseSearchRegistrationOptions& o) {
  using Kind = RefusalReason::Kind;
  std::vector<RefusalReason> reasons;
  if (!(r.log_likelihood_ratio >= o.min_log_likelihood_ratio)) {
    reasons.push_back(
        {Kind::kLogLikelihoodRatio, r.log_likelihood_ratio, o.min_log_likelihood_ratio, {}, {}});
  }
  if (!(r.tre_99_m <= o.max_tre_99_m)) {
    reasons.push_back({Kind::kTre99AtEnds, r.tre_99_m, o.max_tre_99_m, {}, {}});
  }
  return reasons;
}

std::optional<RefusalReason> error_at_screws(const Registration& r,
                                             const PoseSearchRegistrationOptions& o) {
  using Kind = RefusalReason::Kind;
  if (!(r.predicted_tre_m <= o.max_predicted_tre_m)) {
    return RefusalReason{
        Kind::kTreAtScrews, r.predicted_tre_m, o.max_predicted_tre_m, r.weakest, {}, {}};
  }
  if (!(r.tre_99_m <= o.max_tre_99_m)) {
    return RefusalReason{Kind::kTre99AtScrews, r.tre_99_m, o.max_tre_99_m, r.weakest, {}, {}};
  }
  return std::nullopt;
}

bool is_provisional(const Registration& r) {
  using Kind = RefusalReason::Kind;
  const auto about_error = [](const RefusalReason& reason) {
    return reason.kind == Kind::kTreAtScrews || reason.kind == Kind::kTre99AtScrews ||
           reason.kind == Kind::kSoftTissue;
  };
  return !r.reasons.empty() && std::all_of(r.reasons.begin(), r.reasons.end(), about_error) &&
         r.uncertainty && r.predicted_tre_m <= kMaxProvisional_m;
}

}  // namespace orthonav::nav
