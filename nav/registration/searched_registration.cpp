#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "nav/registration/degeneracy.h"
#include "nav/registration/fit_covariance.h"
#include "nav/registration/pose_candidates.h"
#include "nav/registration/registration.h"
#include "nav/registration/shaft_collision.h"
#include "nav/registration/surface_fit.h"
#include "nav/registration/verdict.h"

namespace orthonav::nav {
namespace {

/// A standoff is used where it is this many times its SD.
constexpr double kCertainSd = 3.5;
/// A rival whose margin is below this many times the least one is looked at more closely.
constexpr double kDoubtful = 3.0;
/// Points within this many SDs lie on the surface.
constexpr double kInlierSd = 3.5;
/// A level that explains the points nearly as well as this one does.
constexpr double kLevelLogLikelihoodRatio = 6.0;

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

struct CertainFit {
  SurfaceFit fit;
  std::optional<FitCovariance> covariance;
};

/// Fits all points, starting from the best candidate's pose.
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

/// A pose that competes with the best one.
struct Rival {
  CentredPose pose;
  double rmse_m = 0.0;
  double log_likelihood_ratio = 0.0;
};

/// How much worse the best other pose explains the points. A rival that explains them nearly as
/// well is first fitted to all points, which may lead it to the best pose.
class RivalSearch {
 public:
  RivalSearch(const VertebraModel& model, const Cloud& cloud, const CertainFit& best,
              double width_m, std::span<const Point<Vertebra>> targets,
              const PoseSearchRegistrationOptions& options, const Registration& r)
      : model_(model),
        cloud_(cloud),
        width_m_(width_m),
        targets_(targets),
        world_from_vertebra_(r.world_from_vertebra),
        doubtful_(kDoubtful * options.min_log_likelihood_ratio),
        best_cost_m2_(truncated_cost_m2(best.fit, width_m)) {
    const double points = r.effective_points > 0.0 ? r.effective_points : 10.0;
    unit_m2_ = 2.0 * r.noise_m * r.noise_m / points;
    fine_.tip_radius_m = options.tip_radius_m;
    fine_.point_sd_m = options.point_sd_m;
    fine_.with_standoff = best.fit.with_standoff;
  }

  /// Nothing where it is the best pose, or is led to it.
  [[nodiscard]] std::optional<Rival> judged(const Candidate& candidate,
                                            const Candidate& first) const {
    Rival rival{candidate.fit.pose, rmse_m(candidate.fit),
                (candidate.cost_m2 - first.cost_m2) / unit_m2_};
    if (!is_another(rival.pose)) {
      return std::nullopt;
    }
    if (!(rival.log_likelihood_ratio < doubtful_)) {
      return rival;
    }
    const auto whole = fit_to_surface(model_.reachable_surface(), cloud_.all_m, rival.pose, fine_);
    if (!whole || !is_another(whole->pose)) {
      return std::nullopt;
    }
    return Rival{whole->pose, rmse_m(*whole),
                 (truncated_cost_m2(*whole, width_m_) - best_cost_m2_) / unit_m2_};
  }

 private:
  [[nodiscard]] bool is_another(const CentredPose& pose) const {
    return apart_m(world_from(pose, cloud_.centre_m), world_from_vertebra_, targets_) >=
           kSameAtTargets_m;
  }

  const VertebraModel& model_;
  const Cloud& cloud_;
  double width_m_;
  std::span<const Point<Vertebra>> targets_;
  Transform<World, Vertebra> world_from_vertebra_;
  double doubtful_;
  double best_cost_m2_;
  double unit_m2_ = 0.0;
  SurfaceFitOptions fine_;
};

void compare_poses(const RivalSearch& search, std::span<const Candidate> found, Vec3 centre_m,
                   Registration& r) {
  r.log_likelihood_ratio = std::numeric_limits<double>::infinity();
  r.runner_up = r.world_from_vertebra;
  r.runner_up_rmse_m = r.rmse_m;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const auto rival = search.judged(found[i], found[0]);
    if (!rival || rival->log_likelihood_ratio >= r.log_likelihood_ratio) {
      continue;
    }
    r.runner_up = world_from(rival->pose, centre_m);
    r.runner_up_rmse_m = rival->rmse_m;
    r.log_likelihood_ratio = rival->log_likelihood_ratio;
  }
}

/// Notes the neighbouring level that explains the points best, if it does so nearly as well as this
/// one.
void compare_levels(const Cloud& cloud, double own_cost_m2, double width_m,
                    const PoseSearchRegistrationOptions& options, Registration& r) {
  const double points = r.effective_points > 0.0 ? r.effective_points : 10.0;
  double least = own_cost_m2 + 2.0 * kLevelLogLikelihoodRatio * r.noise_m * r.noise_m / points;
  for (const NeighbourLevel& level : options.neighbours) {
    const auto found = find_candidates(*level.model, cloud, {}, options.tip_radius_m);
    if (found.best_first.empty()) {
      continue;
    }
    const double cost =
        truncated_cost_m2(found.best_first[0].fit, std::min(width_m, found.width_m));
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
  auto [found, width_m] = find_candidates(model, cloud, targets, options.tip_radius_m);
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
  compare_poses(RivalSearch(model, cloud, *certain, width_m, targets, options, r), found,
                cloud.centre_m, r);
  compare_levels(cloud, truncated_cost_m2(found[0].fit, width_m), width_m, options, r);
  r.reasons = reasons_against(r, options);
  r.accepted = r.reasons.empty();
  return r;
}

}  // namespace orthonav::nav
