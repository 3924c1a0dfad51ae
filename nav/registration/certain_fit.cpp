#include "nav/registration/certain_fit.h"

#include <vector>

namespace orthonav::nav {
namespace {

/// Points beyond the rim of the reachable surface are nearer to bone that registration leaves out:
/// their height above the rim says nothing.
void drop_beyond_rim(const VertebraModel& model, SurfaceFit& fit) {
  constexpr double kNearer = 1.0 - 1e-6;
  for (FittedPoint& p : fit.points) {
    const Vec3 at = p.lever_arm_m + fit.pose.centre_m;
    if (p.weight > 0.0 && model.surface().nearest(at, kNearer * (at - p.nearest_m).norm())) {
      p.weight = 0.0;
    }
  }
}

/// The fit's points at another pose and height.
std::optional<SurfaceFit> moved(const VertebraModel& model, const Cloud& cloud,
                                const SurfaceFit& fit, const ResidualField& field,
                                const PoseSearchRegistrationOptions& options) {
  SurfaceFitOptions there;
  there.tip_radius_m = options.tip_radius_m;
  there.point_sd_m = options.point_sd_m;
  there.max_iterations = 0;
  there.first_standoff_m = field.standoff_m;
  std::vector<Vec3> near_m;
  near_m.reserve(fit.points.size());
  for (const FittedPoint& p : fit.points) {
    near_m.push_back(p.nearest_m);
  }
  there.near_m = near_m;
  CentredPose pose = fit.pose;
  const auto& x = field.step;
  pose.rotation = orthonormalized(rotation_from_vector({x[3], x[4], x[5]}) * pose.rotation);
  pose.centre_m += {x[0], x[1], x[2]};
  auto out = fit_to_surface(model.reachable_surface(), cloud.all_m, pose, there);
  if (out) {
    out->with_standoff = field.standoff_m > 0.0;
    drop_beyond_rim(model, *out);
  }
  return out;
}

}  // namespace

std::optional<CertainFit> final_fit(const VertebraModel& model, const Cloud& cloud,
                                    const SurfaceFit& start,
                                    const PoseSearchRegistrationOptions& options) {
  constexpr int kMostRounds = 4;
  constexpr double kSmallStep_m = 5e-5;
  SurfaceFitOptions fine;
  fine.tip_radius_m = options.tip_radius_m;
  fine.point_sd_m = options.point_sd_m;
  const std::vector<Vec3> near_m = places_near(model, cloud.all_m, start.pose);
  fine.near_m = near_m;
  CertainFit out;
  for (const bool with_standoff : {true, false}) {
    fine.with_standoff = with_standoff;
    auto fit = fit_to_surface(model.reachable_surface(), cloud.all_m, start.pose, fine);
    if (fit && (!with_standoff || is_credible_standoff(fit->standoff_m))) {
      out.fit = std::move(*fit);
      break;
    }
  }
  if (out.fit.points.empty()) {
    return std::nullopt;
  }
  drop_beyond_rim(model, out.fit);
  for (int round = 0; round < kMostRounds; ++round) {
    auto field =
        residual_field(out.fit, out.field ? out.field->hypotheses : std::vector<FieldHypothesis>{});
    if (!field) {
      break;
    }
    auto next = moved(model, cloud, out.fit, *field, options);
    out.field = std::move(field);
    if (!next) {
      break;
    }
    const double step_m = (next->pose.centre_m - out.fit.pose.centre_m).norm();
    out.fit = std::move(*next);
    if (round > 0 && step_m < kSmallStep_m) {
      break;
    }
  }
  return out;
}

}  // namespace orthonav::nav
