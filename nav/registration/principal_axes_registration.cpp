#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/translation.h"
#include "nav/registration/coarse.h"
#include "nav/published/icp.h"
#include "nav/registration/registration.h"
#include "nav/registration/tre.h"

namespace orthonav::nav {
namespace {

void judge(const VertebraModel& model, const RegistrationOptions& options, Registration& r) {
  using Kind = RefusalReason::Kind;
  if (!(r.rmse_m <= options.max_rmse_m)) {
    r.reasons.push_back({Kind::kRmse, r.rmse_m, options.max_rmse_m, {}, {}});
  }
  // Two starts that end in the same pose agree; only a different pose is a rival.
  const bool rival = differ_clearly(model, r.world_from_vertebra, r.runner_up);
  if (rival && !(r.runner_up_rmse_m >= options.min_runner_up_ratio * r.rmse_m)) {
    r.reasons.push_back(
        {Kind::kRunnerUpRmse, r.runner_up_rmse_m / r.rmse_m, options.min_runner_up_ratio, {}, {}});
  }
  if (!(r.predicted_tre_m <= options.max_predicted_tre_m)) {
    r.reasons.push_back(
        {Kind::kTreAtCentre, r.predicted_tre_m, options.max_predicted_tre_m, {}, {}});
  }
  r.accepted = r.reasons.empty();
}

void estimate_errors(const VertebraModel& model, std::span<const Point<World>> points,
                     Registration& r) {
  r.predicted_tre_m = std::numeric_limits<double>::infinity();
  const auto uncertainty = PoseUncertainty::estimate(model, r.world_from_vertebra, points);
  if (!uncertainty) {
    return;
  }
  r.uncertainty = *uncertainty;
  r.predicted_tre_m = uncertainty->predicted_tre_m({bounds_of(model.mesh()).centre()});
}

}  // namespace

Result<Registration> register_by_principal_axes(const VertebraModel& model,
                                                std::span<const Point<World>> points_in_world,
                                                const RegistrationOptions& options) {
  if (const Status s = validate_points(points_in_world, options.min_points); !s) {
    return s.error();
  }
  const IcpOptions fine{options.max_iterations, options.converged_m};
  std::vector<IcpResult> refined;
  for (const CoarsePose& coarse : coarse_poses(model, points_in_world)) {
    auto result =
        refine_icp(model.reachable_surface(), points_in_world, coarse.world_from_vertebra, fine);
    if (result) {
      refined.push_back(*result);
    }
  }
  if (refined.empty()) {
    return Error{translatable(
        "registration finds no pose: the extreme points of the strokes fit no part of the model")};
  }
  if (refined.size() == 1) {
    refined.push_back(refined[0]);
  }
  if (refined[1].rmse_m < refined[0].rmse_m) {
    std::swap(refined[0], refined[1]);
  }
  Registration r;
  r.world_from_vertebra = refined[0].world_from_vertebra;
  r.rmse_m = refined[0].rmse_m;
  r.iterations = refined[0].iterations;
  r.runner_up = refined[1].world_from_vertebra;
  r.runner_up_rmse_m = refined[1].rmse_m;
  r.points = points_in_world.size();
  estimate_errors(model, points_in_world, r);
  judge(model, options, r);
  return r;
}

}  // namespace orthonav::nav
