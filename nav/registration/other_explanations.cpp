#include "nav/registration/other_explanations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nav/registration/every_nth.h"

namespace orthonav::nav {
namespace {

/// A rival whose log-likelihood ratio is below this many times the least one is fitted closely.
constexpr double kDoubtful = 3.0;
/// Below this log-likelihood ratio, another level explains the points nearly as well as this one,
/// or two levels explain them equally well.
constexpr double kLevelLogLikelihoodRatio = 6.0;
/// Number of effective points assumed without a known covariance.
constexpr double kFewPoints = 10.0;
/// Residuals are clamped at this many SDs of the points.
constexpr double kClampSds = 4.0;
constexpr std::size_t kUnitsCompared = 80;
/// This many mirrored points are fitted first. Where they fit worse than the answer by more than
/// `kFarWorse` (log-likelihood ratio), the others are not tried.
constexpr std::size_t kMirroredFew = 150;
constexpr double kFarWorse = 100.0;
/// Every start is first tried with a third of the mirrored points; the best few are refined with
/// all of them.
constexpr std::size_t kEveryMirrored = 3;
constexpr std::size_t kMirroredCloser = 3;
constexpr int kRoughIterations = 3;
constexpr int kCloserIterations = 6;

double fit_rmse_m(const SurfaceFit& fit) {
  double sum = 0.0;
  for (const FittedPoint& p : fit.points) {
    sum += p.residual_m * p.residual_m;
  }
  return std::sqrt(sum / static_cast<double>(fit.points.size()));
}

/// The cloud at a pose, with left and right swapped in the model's frame.
Cloud mirrored_cloud(const Cloud& cloud, const CentredPose& pose) {
  const auto mirrored = [&](Vec3 p) {
    const Vec3 q = pose.rotation * p;
    return Vec3{-q.x, q.y, q.z};
  };
  Cloud out;
  for (const Vec3& p : cloud.all_m) {
    out.all_m.push_back(mirrored(p));
  }
  const std::size_t step = std::max<std::size_t>(1, cloud.few_m.size() / kMirroredFew);
  for (std::size_t i = 0; i < cloud.few_m.size(); i += step) {
    out.few_m.push_back(mirrored(cloud.few_m[i]));
  }
  return out;
}

/// The pose itself, and shifted and turned to every side: a crooked bone's mirror image lies askew.
std::vector<CentredPose> poses_about(const CentredPose& pose) {
  constexpr double kAside_m = 0.003;
  constexpr double kRotated_rad = 0.15;
  std::vector<CentredPose> out{pose};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 along;
      along[axis] = side;
      // There is no bone behind, and none in front that can be reached.
      if (axis != 1) {
        out.push_back({pose.rotation, pose.centre_m + kAside_m * along});
      }
      out.push_back({rotation_from_vector(kRotated_rad * along) * pose.rotation, pose.centre_m});
    }
  }
  return out;
}

}  // namespace

OtherExplanations::OtherExplanations(const VertebraModel& model, const Cloud& cloud,
                                     const MarginalizedFit& best, double width_m,
                                     std::span<const Point<Vertebra>> targets,
                                     const PoseSearchRegistrationOptions& options,
                                     const Registration& r)
    : model_(model),
      cloud_(cloud),
      best_(best),
      width_m_(width_m),
      targets_(targets),
      options_(options),
      world_from_vertebra_(r.world_from_vertebra),
      best_cost_m2_(truncated_cost_m2(best.fit, width_m)) {
  const double points = r.effective_points > 0.0 ? r.effective_points : kFewPoints;
  unit_m2_ = 2.0 * r.noise_m * r.noise_m / points;
  fine_.tip_radius_m = options.tip_radius_m;
  fine_.point_sd_m = options.point_sd_m;
  fine_.with_standoff = best.fit.with_standoff;
  clamp_m_ = kClampSds * r.noise_m;
}

const OtherExplanations::Evidence& OtherExplanations::evidence() const {
  if (!evidence_) {
    ResidualUnits units = residual_units(best_.fit, kUnitsCompared);
    const auto own = residual_field(best_.fit, units, {}, options_.least_model_sd_m);
    evidence_ = Evidence{std::move(units), own ? own->log_evidence : 0.0};
  }
  return *evidence_;
}

double OtherExplanations::log_likelihood_ratio(const SurfaceFit& other) const {
  const double by_cost = (truncated_cost_m2(other, width_m_) - best_cost_m2_) / unit_m2_;
  if (!best_.field || by_cost > kDoubtful * options_.min_log_likelihood_ratio) {
    return by_cost;
  }
  SurfaceFit same_points = other;
  for (std::size_t i = 0; i < same_points.points.size(); ++i) {
    FittedPoint& p = same_points.points[i];
    const double height_m = p.residual_m + other.standoff_m - best_.fit.standoff_m;
    p.residual_m = std::clamp(height_m, -clamp_m_, clamp_m_);
    p.weight = p.precision = best_.fit.points[i].inlier_precision();
  }
  same_points.standoff_m = best_.fit.standoff_m;
  const auto field = residual_field(same_points, refilled(evidence().units, same_points), {},
                                    options_.least_model_sd_m);
  return field ? evidence().log_evidence - field->log_evidence : by_cost;
}

std::size_t OtherExplanations::compare_poses(std::span<const Candidate> found,
                                             Registration& r) const {
  r.log_likelihood_ratio = std::numeric_limits<double>::infinity();
  r.runner_up = r.world_from_vertebra;
  r.runner_up_rmse_m = r.rmse_m;
  std::size_t place = 0;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const auto rival = judged(found[i], found[0]);
    if (!rival || rival->log_likelihood_ratio >= r.log_likelihood_ratio) {
      continue;
    }
    r.runner_up = world_from(rival->pose, cloud_.centre_m);
    r.runner_up_rmse_m = rival->rmse_m;
    r.log_likelihood_ratio = rival->log_likelihood_ratio;
    place = i;
  }
  return place;
}

std::optional<OtherExplanations::Rival> OtherExplanations::judged(const Candidate& candidate,
                                                                  const Candidate& first) const {
  Rival rival{candidate.fit.pose, fit_rmse_m(candidate.fit),
              (candidate.cost_m2 - first.cost_m2) / unit_m2_};
  if (!is_another(rival.pose)) {
    return std::nullopt;
  }
  if (!(rival.log_likelihood_ratio < kDoubtful * options_.min_log_likelihood_ratio)) {
    return rival;
  }
  const auto whole = final_fit(model_, cloud_, candidate.fit, options_, kUnitsCompared);
  if (!whole || !is_another(whole->fit.pose)) {
    return std::nullopt;
  }
  return Rival{whole->fit.pose, fit_rmse_m(whole->fit), log_likelihood_ratio(whole->fit)};
}

bool OtherExplanations::is_another(const CentredPose& pose) const {
  return apart_m(world_from(pose, cloud_.centre_m), world_from_vertebra_, targets_) >=
         kSameAtTargets_m;
}

std::string OtherExplanations::better_level() const {
  double least = std::numeric_limits<double>::infinity();
  double second = least;
  std::string label;
  for (const NeighbourLevel& level : options_.neighbours) {
    const auto found = find_candidates(*level.model, cloud_, {}, options_.tip_radius_m);
    const auto whole = found.best_first.empty() ? std::nullopt
                                                : fit_to_bone(*level.model, cloud_.all_m,
                                                              found.best_first[0].fit.pose, fine_);
    if (!whole) {
      continue;
    }
    const double ratio = log_likelihood_ratio(*whole);
    if (ratio < least) {
      second = least;
      least = ratio;
      label = level.label;
    } else {
      second = std::min(second, ratio);
    }
  }
  if (!(least < kLevelLogLikelihoodRatio)) {
    return {};
  }
  return second - least < kLevelLogLikelihoodRatio ? std::string(kSeveralLevels) : label;
}

double OtherExplanations::mirror_log_likelihood() const {
  const Cloud mirrored = mirrored_cloud(cloud_, best_.fit.pose);
  const auto few = best_mirrored_fit(mirrored.few_m);
  if (!few) {
    return -std::numeric_limits<double>::infinity();
  }
  const double by_cost = (few->cost_m2 - best_cost_m2_) / unit_m2_;
  if (by_cost > kFarWorse) {
    return -by_cost;
  }
  // The mirror image gets the same fit as the answer, but to some of the points; all of them are
  // then compared at the pose where it ends.
  Cloud some;
  some.all_m = every_nth(std::span<const Vec3>(mirrored.all_m), kEveryMirrored);
  PoseSearchRegistrationOptions options;
  options.tip_radius_m = options_.tip_radius_m;
  options.point_sd_m = every_nth(std::span<const double>(options_.point_sd_m), kEveryMirrored);
  const auto whole = final_fit(model_, some, few->fit, options, kUnitsCompared);
  const auto all =
      whole ? fit_at(model_, mirrored.all_m, whole->fit.pose, whole->fit.standoff_m, options_)
            : std::nullopt;
  return all ? -log_likelihood_ratio(*all) : -std::numeric_limits<double>::infinity();
}

std::optional<Candidate> OtherExplanations::best_mirrored_fit(
    std::span<const Vec3> points_m) const {
  CentredPose start;
  start.centre_m = best_.fit.pose.centre_m;
  start.centre_m.x = 2.0 * model_.reachable_axes().centre_m.x - start.centre_m.x;
  const std::vector<Vec3> fewer_m = every_nth(points_m, kEveryMirrored);
  std::vector<Candidate> rough;
  for (const CentredPose& aside : poses_about(start)) {
    if (auto fit = mirrored_fit(fewer_m, aside, kRoughIterations)) {
      rough.push_back(std::move(*fit));
    }
  }
  std::stable_sort(rough.begin(), rough.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost_m2 < b.cost_m2; });
  std::optional<Candidate> best;
  for (std::size_t i = 0; i < std::min(kMirroredCloser, rough.size()); ++i) {
    auto fit = mirrored_fit(points_m, rough[i].fit.pose, kCloserIterations);
    if (fit && (!best || fit->cost_m2 < best->cost_m2)) {
      best = std::move(fit);
    }
  }
  return best;
}

std::optional<Candidate> OtherExplanations::mirrored_fit(std::span<const Vec3> points_m,
                                                         const CentredPose& start,
                                                         int iterations) const {
  SurfaceFitOptions quick = fine_;
  quick.point_sd_m = {};
  quick.max_iterations = iterations;
  auto fit = fit_to_bone(model_, points_m, start, quick);
  if (!fit) {
    return std::nullopt;
  }
  const double cost_m2 = truncated_cost_m2(*fit, width_m_);
  return Candidate{std::move(*fit), cost_m2};
}

}  // namespace orthonav::nav
