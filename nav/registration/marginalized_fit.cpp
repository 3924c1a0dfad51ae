#include "nav/registration/marginalized_fit.h"

#include <algorithm>
#include <vector>

#include "nav/registration/every_nth.h"

namespace orthonav::nav {
namespace {

/// The robust fit takes about this many of the points; the rounds after it take all of them.
constexpr std::size_t kFittedRobustly = 700;
/// Which points lie beyond the rim is determined again once the bone has moved by more than this.
constexpr double kRimRecheck_m = 0.0005;

/// Points beyond the rim of the reachable surface are nearer to bone that registration leaves out,
/// so their height above the rim is meaningless.
class BeyondRim {
 public:
  explicit BeyondRim(const VertebraModel& model) : model_(model) {}

  void drop_from(SurfaceFit& fit) {
    if (beyond_.empty() || (fit.pose.centre_m - found_at_m_).norm() > kRimRecheck_m) {
      find(fit);
    }
    for (std::size_t i = 0; i < fit.points.size(); ++i) {
      if (beyond_[i]) {
        fit.points[i].weight = 0.0;
      }
    }
  }

 private:
  void find(const SurfaceFit& fit) {
    constexpr double kNearer = 1.0 - 1e-6;
    beyond_.assign(fit.points.size(), false);
    found_at_m_ = fit.pose.centre_m;
    for (std::size_t i = 0; i < fit.points.size(); ++i) {
      const FittedPoint& p = fit.points[i];
      const Vec3 at = p.lever_arm_m + fit.pose.centre_m;
      beyond_[i] =
          p.weight > 0.0 && model_.surface().nearest(at, kNearer * (at - p.nearest_m).norm());
    }
  }

  const VertebraModel& model_;
  std::vector<bool> beyond_;
  Vec3 found_at_m_;
};

/// Fits a part of the points robustly: standoff and pose, or the pose alone if there is no credible
/// standoff. Nothing if no point is near the surface.
std::optional<SurfaceFit> robust_fit(const VertebraModel& model, std::span<const Vec3> points_m,
                                     const CentredPose& start,
                                     const PoseSearchRegistrationOptions& options) {
  const std::size_t step = std::max<std::size_t>(1, points_m.size() / kFittedRobustly);
  const std::vector<Vec3> some_m = every_nth(points_m, step);
  const std::vector<Vec3> near_m = places_near(model, some_m, start);
  const std::vector<double> sd_m = every_nth(std::span<const double>(options.point_sd_m), step);
  SurfaceFitOptions fine;
  fine.tip_radius_m = options.tip_radius_m;
  fine.point_sd_m = sd_m;
  fine.near_m = near_m;
  for (const bool with_standoff : {true, false}) {
    fine.with_standoff = with_standoff;
    auto fit = fit_to_surface(model.reachable_surface(), some_m, start, fine);
    if (fit && (!with_standoff || is_credible_standoff(fit->standoff_m))) {
      return fit;
    }
  }
  return std::nullopt;
}

/// All points at a pose and height; `near_m`: places on the surface near each of them.
std::optional<SurfaceFit> fit_near(const VertebraModel& model, std::span<const Vec3> points_m,
                                   const CentredPose& pose, double standoff_m,
                                   std::span<const Vec3> near_m,
                                   const PoseSearchRegistrationOptions& options) {
  SurfaceFitOptions there;
  there.tip_radius_m = options.tip_radius_m;
  there.point_sd_m = options.point_sd_m;
  there.max_iterations = 0;
  there.first_standoff_m = standoff_m;
  there.near_m = near_m;
  return fit_to_surface(model.reachable_surface(), points_m, pose, there);
}

/// The fit's points at another pose and height.
std::optional<SurfaceFit> moved(const VertebraModel& model, const Cloud& cloud,
                                const SurfaceFit& fit, const ResidualField& field,
                                const PoseSearchRegistrationOptions& options) {
  std::vector<Vec3> near_m;
  near_m.reserve(fit.points.size());
  for (const FittedPoint& p : fit.points) {
    near_m.push_back(p.nearest_m);
  }
  CentredPose pose = fit.pose;
  const auto& x = field.step;
  pose.rotation = orthonormalized(rotation_from_vector({x[3], x[4], x[5]}) * pose.rotation);
  pose.centre_m += {x[0], x[1], x[2]};
  auto out = fit_near(model, cloud.all_m, pose, field.standoff_m, near_m, options);
  if (out) {
    out->with_standoff = field.standoff_m > 0.0;
  }
  return out;
}

}  // namespace

std::optional<SurfaceFit> fit_at(const VertebraModel& model, std::span<const Vec3> points_m,
                                 const CentredPose& pose, double standoff_m,
                                 const PoseSearchRegistrationOptions& options) {
  return fit_near(model, points_m, pose, standoff_m, places_near(model, points_m, pose), options);
}

namespace {

/// All points at the pose of a part of them.
std::optional<SurfaceFit> first_fit(const VertebraModel& model, const Cloud& cloud,
                                    const SurfaceFit& start,
                                    const PoseSearchRegistrationOptions& options) {
  const auto robust = robust_fit(model, cloud.all_m, start.pose, options);
  if (!robust) {
    return std::nullopt;
  }
  auto out = fit_at(model, cloud.all_m, robust->pose, robust->standoff_m, options);
  if (out) {
    out->with_standoff = robust->with_standoff;
    out->iterations = robust->iterations;
  }
  return out;
}

}  // namespace

std::optional<MarginalizedFit> final_fit(const VertebraModel& model, const Cloud& cloud,
                                         const SurfaceFit& start,
                                         const PoseSearchRegistrationOptions& options,
                                         std::size_t units) {
  constexpr int kMaxRounds = 4;
  constexpr double kSmallStep_m = 5e-5;
  auto first = first_fit(model, cloud, start, options);
  if (!first) {
    return std::nullopt;
  }
  MarginalizedFit out{std::move(*first), std::nullopt};
  BeyondRim beyond_rim(model);
  beyond_rim.drop_from(out.fit);
  for (int round = 0; round < kMaxRounds; ++round) {
    auto field = residual_field(out.fit, residual_units(out.fit, units),
                                out.field ? out.field->hypotheses : std::vector<FieldHypothesis>{},
                                options.least_model_sd_m);
    if (!field) {
      break;
    }
    auto next = moved(model, cloud, out.fit, *field, options);
    out.field = std::move(field);
    if (!next) {
      break;
    }
    const double step_m = (next->pose.centre_m - out.fit.pose.centre_m).norm();
    next->iterations = out.fit.iterations + 1;
    out.fit = std::move(*next);
    beyond_rim.drop_from(out.fit);
    if (round > 0 && step_m < kSmallStep_m) {
      break;
    }
  }
  return out;
}

}  // namespace orthonav::nav
