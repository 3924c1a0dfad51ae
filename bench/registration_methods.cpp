#include "bench/registration_methods.h"

#include <array>

#include "bench/registration_peers.h"
#include "engine/session/text/wording.h"
#include "nav/guidance/predicted_error.h"
#include "nav/published/registration.h"

namespace orthonav::bench {
namespace {

Mat3 predicted_covariance(const nav::PoseUncertainty& uncertainty, Point<Vertebra> at) {
  const std::array<double, 9> c = uncertainty.covariance_at(at);
  return {{{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}}}};
}

Fitted told_by(const Result<nav::Registration>& r) {
  Fitted fitted;
  if (!r) {
    fitted.reason = r.error().message;
    return fitted;
  }
  fitted.found = true;
  fitted.world_from_vertebra = r->world_from_vertebra;
  fitted.accepted = r->accepted;
  for (const nav::RefusalReason& reason : r->reasons) {
    fitted.reason += (fitted.reason.empty() ? "" : "; ") + engine::text_of(reason);
  }
  fitted.rmse_m = r->rmse_m;
  fitted.fits_better = r->fits_better;
  if (r->uncertainty) {
    fitted.covariance = [uncertainty = *r->uncertainty](Point<Vertebra> at) {
      return predicted_covariance(uncertainty, at);
    };
  }
  return fitted;
}

/// The published method refuses nothing.
Fitted told_as_published(const Result<std::array<nav::published::IcpResult, 2>>& r) {
  Fitted fitted;
  if (!r) {
    fitted.reason = r.error().message;
    return fitted;
  }
  fitted.found = true;
  fitted.accepted = true;
  fitted.world_from_vertebra = r->front().world_from_vertebra;
  fitted.rmse_m = r->front().rmse_m;
  return fitted;
}

RegistrationMethod paper() {
  return {"paper",
          [](const BenchLevel& level) -> Fit {
            return [model = level.model](std::span<const Point<World>> points,
                                         std::span<const double>) {
              return told_as_published(nav::published::register_points(
                  model->reachable(), model->reachable_surface(), points));
            };
          },
          true};
}

RegistrationMethod best(double common_m) {
  return {"best",
          [common_m](const BenchLevel& level) -> Fit {
            nav::PoseSearchRegistrationOptions options;
            options.targets = nav::entries_and_targets(level.screws);
            options.common.tip_m = common_m;
            options.neighbours = level.neighbours;
            return [model = level.model, options](std::span<const Point<World>> points,
                                                  std::span<const double> times_s) mutable {
              options.times_s.assign(times_s.begin(), times_s.end());
              return told_by(nav::register_by_pose_search(*model, points, options));
            };
          },
          true};
}

}  // namespace

std::vector<RegistrationMethod> registration_methods(double common_m) {
  std::vector<RegistrationMethod> methods{
      paper(),
      best(common_m),
  };
#ifdef ORTHONAV_BENCH_PCL
  for (auto& peer : pcl_methods()) {
    methods.push_back(std::move(peer));
  }
#endif
#ifdef ORTHONAV_BENCH_OPEN3D
  for (auto& peer : open3d_methods()) {
    methods.push_back(std::move(peer));
  }
#endif
  return methods;
}

}  // namespace orthonav::bench
