#include "bench/registration_methods.h"

#include "bench/registration_peers.h"

namespace orthonav::bench {
namespace {

/// Of the error at a place. A root mean square alone is taken to be the same in all directions.
Mat3 predicted_covariance(const nav::Registration& registration, Point<Vertebra> at) {
  const double rms_m = registration.uncertainty->predicted_tre_m(at);
  Mat3 covariance;
  for (int i = 0; i < 3; ++i) covariance[i][i] = rms_m * rms_m / 3.0;
  return covariance;
}

using Register = Result<nav::Registration> (*)(const nav::VertebraModel&,
                                               std::span<const Point<World>>,
                                               const nav::RegistrationOptions&);

RegistrationMethod ours(const std::string& name, Register method) {
  const auto prepare = [method](const BenchLevel& level) -> Fit {
    return [method, model = level.model](std::span<const Point<World>> points) {
      Fitted fitted;
      const auto r = method(*model, points, {});
      if (!r) {
        fitted.reason = r.error().message;
        return fitted;
      }
      fitted.found = true;
      fitted.world_from_vertebra = r->world_from_vertebra;
      fitted.accepted = r->accepted;
      for (const std::string& reason : r->reasons)
        fitted.reason += (fitted.reason.empty() ? "" : "; ") + reason;
      fitted.rmse_m = r->rmse_m;
      if (r->uncertainty)
        fitted.covariance = [registration = *r](Point<Vertebra> at) {
          return predicted_covariance(registration, at);
        };
      return fitted;
    };
  };
  return {name, prepare, true};
}

}  // namespace

std::vector<RegistrationMethod> registration_methods() {
  std::vector<RegistrationMethod> methods{
      ours("paper", nav::register_paper),
  };
#ifdef ORTHONAV_BENCH_PCL
  for (auto& peer : pcl_methods()) methods.push_back(std::move(peer));
#endif
#ifdef ORTHONAV_BENCH_OPEN3D
  for (auto& peer : open3d_methods()) methods.push_back(std::move(peer));
#endif
  return methods;
}

}  // namespace orthonav::bench
