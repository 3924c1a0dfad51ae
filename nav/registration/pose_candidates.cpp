#include "nav/registration/pose_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nav/registration/pose_search.h"
#include "nav/registration/spread_points.h"

namespace orthonav::nav {
namespace {

/// Enough points to tell candidates apart.
constexpr std::size_t kPointsToCompare = 300;
constexpr double kFieldNoise_m = 0.0005;
/// The field is accurate to tenths of a millimetre: a pose whose cost in the field is this many
/// times the best one's is not a rival.
constexpr double kFarFromBestInField = 3.0;
/// Squared distances are truncated at this many SDs of the noise, but not below that distance.
constexpr double kTruncateSd = 3.0;
constexpr double kTruncateLeast_m = 0.0009;
/// Points that scatter by more than this, more than tracking explains, were stroked with a light
/// hand or over soft tissue. Their mean height above the bone is then fitted as well, in the bone
/// never.
constexpr double kLooseHand_m = 0.0005;
constexpr double kHighest_m = 0.004;

SurfaceFitOptions quick_fit(double tip_radius_m) {
  SurfaceFitOptions options;
  options.tip_radius_m = tip_radius_m;
  options.max_iterations = 6;
  options.last_step_m = 2e-5;
  return options;
}

double least_noise_m(std::span<const Candidate> candidates) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    least_m = std::min(least_m, c.fit.noise_m);
  }
  return least_m;
}

/// Fits the candidates again with the mean height of the tip above the bone unknown.
void refit_with_standoff(const VertebraModel& model, const Cloud& cloud, SurfaceFitOptions options,
                         std::span<Candidate> candidates) {
  options.with_standoff = true;
  for (Candidate& c : candidates) {
    if (auto fit = fit_to_surface(model.reachable_surface(), cloud.few_m, c.fit.pose, options);
        fit && fit->standoff_m > 0.0 && fit->standoff_m < kHighest_m) {
      c.fit = std::move(*fit);
    }
  }
}

/// The poses found in the field, fitted, in the order found.
std::vector<Candidate> fitted_poses(const VertebraModel& model, const Cloud& cloud,
                                    std::span<const Point<Vertebra>> targets,
                                    const SurfaceFitOptions& options) {
  PoseSearchOptions search;
  search.tip_radius_m = options.tip_radius_m;
  std::vector<Vec3> in_world;
  for (const Vec3& p : cloud.all_m) {
    in_world.push_back(p + cloud.centre_m);
  }
  const std::vector<FoundPose> poses = search_poses(model.search_field(), in_world, search);
  std::vector<Candidate> found;
  bool rivals = false;
  for (const FoundPose& pose : poses) {
    const double least_cost_m2 = std::max(poses[0].cost_m2, kFieldNoise_m * kFieldNoise_m);
    if (rivals && pose.cost_m2 > kFarFromBestInField * least_cost_m2) {
      break;
    }
    rivals =
        rivals || targets.empty() ||
        apart_m(pose.world_from_vertebra, poses[0].world_from_vertebra, targets) > kSameAtTargets_m;
    const CentredPose start = centred(pose.world_from_vertebra, cloud.centre_m);
    if (auto fit = fit_to_bone(model, cloud.few_m, start, options)) {
      found.push_back({std::move(*fit), 0.0});
    }
  }
  return found;
}

}  // namespace

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

double apart_m(const Transform<World, Vertebra>& a, const Transform<World, Vertebra>& b,
               std::span<const Point<Vertebra>> targets) {
  double most = 0.0;
  for (const Point<Vertebra>& target : targets) {
    most = std::max(most, (a * target - b * target).norm());
  }
  return most;
}

std::optional<SurfaceFit> fit_to_bone(const VertebraModel& model, std::span<const Vec3> points_m,
                                      const CentredPose& start, SurfaceFitOptions options) {
  std::vector<Vec3> near_m;
  near_m.reserve(points_m.size());
  for (const Vec3& p : points_m) {
    near_m.push_back(model.reachable_grid().nearest(start.rotation * p + start.centre_m));
  }
  options.near_m = near_m;
  return fit_to_surface(model.reachable_surface(), points_m, start, options);
}

std::vector<Candidate> find_candidates(const VertebraModel& model, const Cloud& cloud,
                                       std::span<const Point<Vertebra>> targets,
                                       double tip_radius_m) {
  const SurfaceFitOptions options = quick_fit(tip_radius_m);
  std::vector<Candidate> found = fitted_poses(model, cloud, targets, options);
  if (least_noise_m(found) > kLooseHand_m) {
    refit_with_standoff(model, cloud, options, found);
  }
  const double width_m = std::max(kTruncateSd * least_noise_m(found), kTruncateLeast_m);
  for (Candidate& c : found) {
    c.cost_m2 = truncated_cost_m2(c.fit, width_m);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.cost_m2 < b.cost_m2; });
  return found;
}

}  // namespace orthonav::nav
