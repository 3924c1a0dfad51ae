#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "nav/registration/degeneracy.h"
#include "nav/registration/fit_covariance.h"
#include "nav/registration/pose_search.h"
#include "nav/registration/registration.h"
#include "nav/registration/shaft_collision.h"
#include "nav/registration/spread_points.h"
#include "nav/registration/surface_fit.h"
#include "nav/registration/verdict.h"

namespace orthonav::nav {
namespace {

/// Enough points to tell candidates apart.
constexpr std::size_t kPointsToCompare = 300;
constexpr double kFieldNoise_m = 0.0005;
constexpr double kFarFromBest = 3.0;
/// Poses are compared by squared distances truncated at so many SDs of the noise, or there.
constexpr double kTruncateSd = 3.0;
constexpr double kTruncateLeast_m = 0.0009;
/// A pose that moves no target farther is not another one.
constexpr double kSameAtTargets_m = 0.002;
/// Points that scatter more than a tracker's were stroked by a light hand, or over soft tissue:
/// their mean height above the bone is asked for then, and used when it is as certain as that.
constexpr double kLooseHand_m = 0.0005;
constexpr double kCertainSd = 3.5;
constexpr double kHighest_m = 0.004;
/// Of the least margin: a rival within it is looked at closer.
constexpr double kDoubtful = 3.0;
/// Points within this many SDs lie on the surface.
constexpr double kInlierSd = 3.5;
/// A level that explains the points nearly as well as this one does.
constexpr double kLevelLogLikelihoodRatio = 6.0;

struct Cloud {
  std::vector<Vec3> all_m;  ///< about the centre, in the order of time
  std::vector<Vec3> few_m;
  Vec3 centre_m;
};

Cloud cloud_of(std::span<const Point<World>> points) {
  constexpr double kReach_m = 0.075;
  Cloud cloud;
  for (const Point<World>& p : points) {
    cloud.all_m.push_back(p.v);
  }
  const SpreadPoints spread(cloud.all_m, kReach_m);
  cloud.centre_m = spread.centre_m();
  for (Vec3& p : cloud.all_m) {
    p -= cloud.centre_m;
  }
  const std::size_t step = std::max<std::size_t>(1, cloud.all_m.size() / kPointsToCompare);
  for (std::size_t i = 0; i < cloud.all_m.size(); i += step) {
    cloud.few_m.push_back(cloud.all_m[i]);
  }
  return cloud;
}

/// How far apart two poses put the farthest of the targets.
double apart_m(const Transform<World, Vertebra>& a, const Transform<World, Vertebra>& b,
               std::span<const Point<Vertebra>> targets) {
  double most = 0.0;
  for (const Point<Vertebra>& target : targets) {
    most = std::max(most, (a * target - b * target).norm());
  }
  return most;
}

/// The tip does not dive into bone.
bool is_credible_standoff(double standoff_m) { return standoff_m > 0.0 && standoff_m < kHighest_m; }

struct Candidate {
  SurfaceFit fit;
  double cost_m2 = 0.0;
};

/// The points again, their mean height above the bone being unknown; returns the least noise.
double refit_with_standoff(const VertebraModel& model, const Cloud& cloud, SurfaceFitOptions fine,
                           std::vector<Candidate>& candidates) {
  fine.with_standoff = true;
  double least_m = std::numeric_limits<double>::infinity();
  for (Candidate& c : candidates) {
    if (auto fit = fit_to_surface(model.reachable_surface(), cloud.few_m, c.fit.pose, fine);
        fit && is_credible_standoff(fit->standoff_m)) {
      c.fit = std::move(*fit);
    }
    least_m = std::min(least_m, c.fit.noise_m);
  }
  return least_m;
}

/// Every pose that could be meant, fitted exactly, the best first.
/// Goes on until one is another pose at the targets, where any are given.
std::vector<Candidate> candidates(const VertebraModel& model, const Cloud& cloud,
                                  std::span<const Point<Vertebra>> targets, double tip_radius_m,
                                  double& width_m) {
  PoseSearchOptions search;
  search.tip_radius_m = tip_radius_m;
  SurfaceFitOptions fine;
  fine.tip_radius_m = tip_radius_m;
  fine.max_iterations = 6;
  fine.last_step_m = 2e-5;
  std::vector<Candidate> found;
  double least_m = std::numeric_limits<double>::infinity();
  std::optional<double> least_cost_m2;
  std::optional<Transform<World, Vertebra>> first;
  bool rivals = false;
  std::vector<Vec3> in_world;
  for (const Vec3& p : cloud.all_m) {
    in_world.push_back(p + cloud.centre_m);
  }
  for (const FoundPose& pose : search_poses(model.search_field(), in_world, search)) {
    // The field is right to tenths of a millimetre: what it finds far worse is no rival.
    if (rivals && pose.cost_m2 > kFarFromBest * (*least_cost_m2)) {
      break;
    }
    if (!first) {
      first = pose.world_from_vertebra;
    }
    rivals = rivals || targets.empty() ||
             apart_m(pose.world_from_vertebra, *first, targets) > kSameAtTargets_m;
    if (!least_cost_m2) {
      least_cost_m2 = std::max(pose.cost_m2, kFieldNoise_m * kFieldNoise_m);
    }
    if (auto fit = fit_to_surface(model.reachable_surface(), cloud.few_m,
                                  centred(pose.world_from_vertebra, cloud.centre_m), fine)) {
      least_m = std::min(least_m, fit->noise_m);
      found.push_back({std::move(*fit), 0.0});
    }
  }
  if (least_m > kLooseHand_m) {
    least_m = refit_with_standoff(model, cloud, fine, found);
  }
  width_m = std::max(kTruncateSd * least_m, kTruncateLeast_m);
  for (Candidate& c : found) {
    c.cost_m2 = truncated_cost_m2(c.fit, width_m);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost_m2 < b.cost_m2; });
  return found;
}

std::vector<Point<Vertebra>> targets_of(const VertebraModel& model,
                                        const PoseSearchRegistrationOptions& options) {
  if (!options.targets.empty()) {
    return options.targets;
  }
  // Pedicle screws enter about 20 mm beside the midline and end in the body.
  const Vec3 back = model.reachable_axes().centre_m;
  std::vector<Point<Vertebra>> usual;
  for (const double side : {1.0, -1.0}) {
    usual.push_back({back + Vec3{side * 0.020, 0.0, 0.0}});
    usual.push_back({back + Vec3{side * 0.008, -0.045, 0.0}});
  }
  return usual;
}

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

void estimate_errors(const VertebraModel& model, const std::optional<FitCovariance>& covariance,
                     std::span<const Point<Vertebra>> targets, Registration& r) {
  r.predicted_tre_m = r.tre_95_m = std::numeric_limits<double>::infinity();
  if (!covariance) {
    r.weakest = UncertainMotion{};
    return;
  }
  r.uncertainty = covariance->uncertainty;
  r.effective_points = covariance->effective_points;
  r.predicted_tre_m = r.tre_95_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    r.predicted_tre_m = std::max(r.predicted_tre_m, r.uncertainty->predicted_tre_m(target));
    r.tre_95_m = std::max(r.tre_95_m, r.uncertainty->tre_quantile_m(target, 0.95));
  }
  const Degeneracy degeneracy = degeneracy_of(model, *r.uncertainty, targets);
  r.weakest = degeneracy.motion;
  r.stroke_next = degeneracy.stroke_next;
}

/// Poses at which the pointer would have gone through bone are none, as long as another is left.
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

struct CertainFit {
  SurfaceFit fit;
  std::optional<FitCovariance> covariance;
};

/// All points, from the best candidate's pose on.
std::optional<CertainFit> final_fit(const VertebraModel& model, const Cloud& cloud,
                                    const SurfaceFit& start,
                                    const PoseSearchRegistrationOptions& options) {
  SurfaceFitOptions fine;
  fine.tip_radius_m = options.tip_radius_m;
  fine.point_sd_m = options.point_sd_m;
  for (const bool with_standoff : {true, false}) {
    if (with_standoff && !(start.noise_m > kLooseHand_m || start.with_standoff)) {
      continue;
    }
    fine.with_standoff = with_standoff;
    auto fit = fit_to_surface(model.reachable_surface(), cloud.all_m, start.pose, fine);
    if (!fit) {
      continue;
    }
    auto covariance = covariance_of(*fit);
    if (!with_standoff || (is_credible_standoff(fit->standoff_m) && covariance &&
                           fit->standoff_m > kCertainSd * covariance->standoff_sd_m)) {
      return CertainFit{std::move(*fit), covariance};
    }
  }
  return std::nullopt;
}

/// How much worse the best other pose explains the points.
/// One that does so hardly is fitted to all points first, which may lead it to the same place.
void compare_poses(const VertebraModel& model, const std::vector<Candidate>& found,
                   const CertainFit& best, const Cloud& cloud, double width_m,
                   std::span<const Point<Vertebra>> targets,
                   const PoseSearchRegistrationOptions& options, Registration& r) {
  r.log_likelihood_ratio = std::numeric_limits<double>::infinity();
  r.runner_up = r.world_from_vertebra;
  r.runner_up_rmse_m = r.rmse_m;
  const double points = r.effective_points > 0.0 ? r.effective_points : 10.0;
  const double unit_m2 = 2.0 * r.noise_m * r.noise_m / points;
  SurfaceFitOptions fine;
  fine.tip_radius_m = options.tip_radius_m;
  fine.point_sd_m = options.point_sd_m;
  fine.with_standoff = best.fit.with_standoff;
  const double best_cost_m2 = truncated_cost_m2(best.fit, width_m);
  for (std::size_t i = 1; i < found.size(); ++i) {
    CentredPose pose = found[i].fit.pose;
    double rmse = rmse_m(found[i].fit);
    double log_likelihood_ratio = (found[i].cost_m2 - found[0].cost_m2) / unit_m2;
    const auto is_another = [&] {
      return apart_m(world_from(pose, cloud.centre_m), r.world_from_vertebra, targets) >=
             kSameAtTargets_m;
    };
    if (!is_another()) {
      continue;
    }
    if (log_likelihood_ratio < kDoubtful * options.min_log_likelihood_ratio) {
      const auto whole = fit_to_surface(model.reachable_surface(), cloud.all_m, pose, fine);
      if (!whole) {
        continue;
      }
      pose = whole->pose;
      rmse = rmse_m(*whole);
      log_likelihood_ratio = (truncated_cost_m2(*whole, width_m) - best_cost_m2) / unit_m2;
      if (!is_another()) {
        continue;
      }
    }
    if (log_likelihood_ratio >= r.log_likelihood_ratio) {
      continue;
    }
    r.runner_up = world_from(pose, cloud.centre_m);
    r.runner_up_rmse_m = rmse;
    r.log_likelihood_ratio = log_likelihood_ratio;
  }
}

/// The neighbouring level that explains the points best, if it does so nearly as well.
void compare_levels(const Cloud& cloud, double own_cost_m2, double width_m,
                    const PoseSearchRegistrationOptions& options, Registration& r) {
  const double points = r.effective_points > 0.0 ? r.effective_points : 10.0;
  double least = own_cost_m2 + 2.0 * kLevelLogLikelihoodRatio * r.noise_m * r.noise_m / points;
  for (const NeighbourLevel& level : options.neighbours) {
    double own_width = 0.0;
    const auto found = candidates(*level.model, cloud, {}, options.tip_radius_m, own_width);
    if (found.empty()) {
      continue;
    }
    const double cost = truncated_cost_m2(found[0].fit, std::min(width_m, own_width));
    if (cost >= least) {
      continue;
    }
    least = cost;
    r.fits_better = level.label;
  }
}

}  // namespace

Result<Registration> register_by_pose_search(const VertebraModel& model,
                                             std::span<const Point<World>> points_in_world,
                                             const PoseSearchRegistrationOptions& options) {
  if (const Status s = check_points(points_in_world, options.min_points); !s) {
    return s.error();
  }
  if (const Status s = check_point_sds(options.point_sd_m, points_in_world.size()); !s) {
    return s.error();
  }
  const Cloud cloud = cloud_of(points_in_world);
  const std::vector<Point<Vertebra>> targets = targets_of(model, options);
  double width_m = 0.0;
  std::vector<Candidate> found = candidates(model, cloud, targets, options.tip_radius_m, width_m);
  drop_impossible(model, cloud, points_in_world, options, found);
  const auto certain =
      found.empty() ? std::nullopt : final_fit(model, cloud, found[0].fit, options);
  if (!certain) {
    return Error{"registration finds no pose: the strokes fit no part of the model"};
  }
  const SurfaceFit& fit = certain->fit;
  Registration r;
  r.world_from_vertebra = world_from(fit.pose, cloud.centre_m);
  r.rmse_m = rmse_m(fit);
  r.noise_m = fit.noise_m;
  r.standoff_m = fit.standoff_m;
  r.inlier_fraction = inlier_fraction(fit);
  r.iterations = fit.iterations;
  r.points = points_in_world.size();
  estimate_errors(model, certain->covariance, targets, r);
  r.coverage_fraction = coverage_fraction(model, fit);
  r.shaft_collision_fraction =
      shaft_collision_fraction(model, r.world_from_vertebra, points_in_world, options.shafts);
  compare_poses(model, found, *certain, cloud, width_m, targets, options, r);
  compare_levels(cloud, truncated_cost_m2(found[0].fit, width_m), width_m, options, r);
  r.reasons = reasons_against(r, options);
  r.accepted = r.reasons.empty();
  return r;
}

}  // namespace orthonav::nav
