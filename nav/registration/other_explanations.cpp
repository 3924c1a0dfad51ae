#include "nav/registration/other_explanations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace orthonav::nav {
namespace {

/// A rival whose log-likelihood ratio is below this many times the least one is fitted closely.
constexpr double kDoubtful = 3.0;
/// A level that explains the points nearly as well as this one does; levels that do so alike.
constexpr double kLevelLogLikelihoodRatio = 6.0;
/// Without a known covariance, points count for little.
constexpr double kFewPoints = 10.0;
/// Of the points' SD: what is farther off than this tells no more.
constexpr double kClampSds = 4.0;
constexpr std::size_t kUnitsCompared = 80;
/// So many mirrored points find their place; where these fit so much worse (log-likelihood ratio),
/// the others are not asked.
constexpr std::size_t kMirroredFew = 150;
constexpr double kHopeless = 100.0;

double fit_rmse_m(const SurfaceFit& fit) {
  double sum = 0.0;
  for (const FittedPoint& p : fit.points) {
    sum += p.residual_m * p.residual_m;
  }
  return std::sqrt(sum / static_cast<double>(fit.points.size()));
}

MirroredPoints mirrored_points(const VertebraModel& model, const Cloud& cloud,
                               const CentredPose& pose) {
  MirroredPoints out;
  const auto mirrored = [&](Vec3 p) {
    const Vec3 q = pose.rotation * p;
    return Vec3{-q.x, q.y, q.z};
  };
  for (const Vec3& p : cloud.all_m) {
    out.all_m.push_back(mirrored(p));
  }
  const std::size_t step = std::max<std::size_t>(1, cloud.few_m.size() / kMirroredFew);
  for (std::size_t i = 0; i < cloud.few_m.size(); i += step) {
    out.few_m.push_back(mirrored(cloud.few_m[i]));
  }
  out.start.centre_m = pose.centre_m;
  out.start.centre_m.x = 2.0 * model.reachable_axes().centre_m.x - pose.centre_m.x;
  return out;
}

}  // namespace

OtherExplanations::OtherExplanations(const VertebraModel& model, const Cloud& cloud,
                                     const CertainFit& best, double width_m,
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
  if (best.field) {
    units_ = residual_units(best.fit, kUnitsCompared);
    const auto own = residual_field(best.fit, units_);
    log_evidence_ = own ? own->log_evidence : 0.0;
  }
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
  const auto field = residual_field(same_points, refilled(units_, same_points));
  return field ? log_evidence_ - field->log_evidence : by_cost;
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
  const auto whole = final_fit(model_, cloud_, candidate.fit, options_);
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
    const auto whole = found.best_first.empty()
                           ? std::nullopt
                           : fit_to_surface(level.model->reachable_surface(), cloud_.all_m,
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
  const MirroredPoints points = mirrored_points(model_, cloud_, best_.fit.pose);
  const auto few = best_mirrored_fit(points);
  if (!few) {
    return -std::numeric_limits<double>::infinity();
  }
  const double by_cost = (truncated_cost_m2(*few, width_m_) - best_cost_m2_) / unit_m2_;
  if (by_cost > kHopeless) {
    return -by_cost;
  }
  SurfaceFitOptions closely = fine_;
  closely.max_iterations = 5;  // the few have brought it near
  const auto whole = fit_to_surface(model_.reachable_surface(), points.all_m, few->pose, closely);
  return whole ? -log_likelihood_ratio(*whole) : -std::numeric_limits<double>::infinity();
}

std::optional<SurfaceFit> OtherExplanations::best_mirrored_fit(const MirroredPoints& points) const {
  constexpr double kAside_m = 0.003;
  SurfaceFitOptions quick = fine_;
  quick.point_sd_m = {};
  quick.max_iterations = 6;
  std::optional<SurfaceFit> best;
  double least_m2 = std::numeric_limits<double>::infinity();
  for (const Vec3 aside : {Vec3{}, Vec3{kAside_m, 0.0, 0.0}, Vec3{-kAside_m, 0.0, 0.0},
                           Vec3{0.0, 0.0, kAside_m}, Vec3{0.0, 0.0, -kAside_m}}) {
    CentredPose start = points.start;
    start.centre_m += aside;
    auto fit = fit_to_surface(model_.reachable_surface(), points.few_m, start, quick);
    if (!fit) {
      continue;
    }
    const double cost_m2 = truncated_cost_m2(*fit, width_m_);
    if (cost_m2 < least_m2) {
      least_m2 = cost_m2;
      best = std::move(fit);
    }
  }
  return best;
}

}  // namespace orthonav::nav
