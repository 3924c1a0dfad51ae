#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/reason.h"
#include "base/translation.h"
#include "nav/registration/degeneracy.h"
#include "nav/registration/errors_at_targets.h"
#include "nav/registration/estimated_heights.h"
#include "nav/registration/marginalized_fit.h"
#include "nav/registration/other_explanations.h"
#include "nav/registration/registration.h"
#include "nav/registration/shaft_collision.h"
#include "nav/registration/verdict.h"

namespace orthonav::nav {
namespace {

/// Points within this many SDs lie on the surface.
constexpr double kInlierSd = 3.5;
/// How much larger a bone appears than it is, per variance of the points, 1/m²; and the factor by
/// which the size varies more than the model of the heights predicts. Measured on the project's own
/// strokes.
constexpr double kSizeByScatter = 0.0105 / (0.0009 * 0.0009);
constexpr double kSizeSds = 1.5;

double rmse_m(const SurfaceFit& fit) {
  double sum = 0.0;
  for (const FittedPoint& p : fit.points) {
    sum += p.residual_m * p.residual_m;
  }
  return std::sqrt(sum / static_cast<double>(fit.points.size()));
}

double inlier_fraction(const SurfaceFit& fit) {
  const auto inliers = std::count_if(
      fit.points.begin(), fit.points.end(),
      [&](const FittedPoint& p) { return std::abs(p.residual_m) < kInlierSd * fit.noise_m; });
  return static_cast<double>(inliers) / static_cast<double>(fit.points.size());
}

void estimate_errors(const VertebraModel& model, const MarginalizedFit& fit,
                     std::span<const Point<Vertebra>> targets, const CommonErrors& common,
                     Registration& r) {
  if (!fit.field) {
    r.predicted_tre_m = r.tre_95_m = r.tre_99_m = std::numeric_limits<double>::infinity();
    r.weakest = UncertainMotion{};
    return;
  }
  r.effective_points = fit.field->effective_points;
  put_errors(model, PoseUncertainty(fit.fit.pose.centre_m, fit.field->covariance), common, targets,
             r);
}

/// Drops poses at which the pointer would have gone through bone, as long as another is left.
void drop_impossible(const VertebraModel& model, const Cloud& cloud,
                     std::span<const Point<World>> points,
                     const PoseSearchRegistrationOptions& options, std::vector<Candidate>& found) {
  const auto is_possible = [&](const Candidate& c) {
    return shaft_collision_fraction(model, world_from(c.fit.pose, cloud.centre_m), points,
                                    options.shafts) <= options.max_shaft_collision_fraction;
  };
  const auto impossible = std::stable_partition(found.begin(), found.end(), is_possible);
  if (impossible != found.begin()) {
    found.erase(impossible, found.end());
  }
}

/// Only for the final pose: the choice between poses does not need them.
void estimate_heights(const MarginalizedFit& certain, Registration& r) {
  if (!certain.field) {
    return;
  }
  const ResidualUnits units = residual_units(certain.fit, kMaxUnits);
  r.heights = estimated_heights(certain.fit, units, *certain.field);
  r.correlation_across_strokes = correlation_across_strokes(certain.fit, units);
}

Registration described(const VertebraModel& model, const Cloud& cloud,
                       const MarginalizedFit& certain, std::span<const Point<Vertebra>> targets,
                       const PoseSearchRegistrationOptions& options) {
  const SurfaceFit& fit = certain.fit;
  Registration r;
  r.world_from_vertebra = world_from(fit.pose, cloud.centre_m);
  r.rmse_m = rmse_m(fit);
  r.noise_m = fit.noise_m;
  r.standoff_m = fit.standoff_m;
  r.inlier_fraction = inlier_fraction(fit);
  r.iterations = fit.iterations;
  r.coverage_fraction = coverage_fraction(model, fit);
  estimate_errors(model, certain, targets, options.common, r);
  if (certain.field) {
    r.field_sd_m = certain.field->field_sd_m;
    // Points that scatter about a curved surface lie, on average, outside it; half of the field's
    // variance is not such scatter.
    const double scatter_m2 = r.noise_m * r.noise_m - 0.5 * r.field_sd_m * r.field_sd_m;
    const double too_large = kSizeByScatter * std::max(0.0, scatter_m2);
    r.size = certain.field->size - too_large;
    r.size_sd = std::hypot(kSizeSds * certain.field->size_sd, 0.5 * too_large);
  }
  return r;
}

}  // namespace

Result<Registration> register_by_pose_search(const VertebraModel& model,
                                             std::span<const Point<World>> points_in_world,
                                             const PoseSearchRegistrationOptions& options) {
  if (const Status s = validate_points(points_in_world, options.min_points, model.bone()); !s) {
    return s.error();
  }
  if (const Status s = check_point_sds(options.point_sd_m, points_in_world.size()); !s) {
    return s.error();
  }
  const Cloud cloud = cloud_of(points_in_world);
  const std::vector<Point<Vertebra>> targets = targets_of(model, options);
  auto [found, width_m] = find_candidates(model, cloud, targets, options.tip_radius_m);
  drop_impossible(model, cloud, points_in_world, options, found);
  // A rival that explains all the points better replaces the best pose.
  constexpr int kMaxSwaps = 2;
  for (int swaps = 0;; ++swaps) {
    const auto certain =
        found.empty() ? std::nullopt : final_fit(model, cloud, found[0].fit, options);
    if (!certain) {
      return refused(
          {translatable("registration finds no pose: the strokes fit no part of the model")});
    }
    Registration r = described(model, cloud, *certain, targets, options);
    r.points = points_in_world.size();
    r.shaft_collision_fraction =
        shaft_collision_fraction(model, r.world_from_vertebra, points_in_world, options.shafts);
    const OtherExplanations others(model, cloud, *certain, width_m, targets, options, r);
    const std::size_t rival = others.compare_poses(found, r);
    if (r.log_likelihood_ratio < 0.0 && swaps < kMaxSwaps) {
      std::swap(found[0], found[rival]);
      continue;
    }
    estimate_heights(*certain, r);
    r.fits_better = others.better_level();
    r.levels_compared = options.neighbours.size();
    if (model.bone() == Bone::kVertebra) {
      r.mirror_log_likelihood = others.mirror_log_likelihood();
      r.reasons = reasons_against(r, options);
    } else {
      r.reasons = reasons_against_any_bone(r, options);
    }
    r.accepted = r.reasons.empty();
    r.provisional = is_provisional(r);
    return r;
  }
}

}  // namespace orthonav::nav
