#include "engine/session/method.h"

#include <limits>

#include "nav/guidance/predicted_error.h"
#include "nav/published/corner_tracker.h"
#include "nav/published/registration.h"

namespace orthonav::engine {
namespace {

/// Never refused: the surgeon judges it by eye. The paper predicts no error.
Result<nav::Registration> by_paper(const RegistrationRequest& request) {
  constexpr std::size_t kFewestPoints = 3;
  if (const Status s = nav::validate_points(request.points_in_world, kFewestPoints); !s) {
    return s.error();
  }
  const auto refined = nav::published::register_points(
      request.model.reachable(), request.model.reachable_surface(), request.points_in_world);
  if (!refined) {
    return refined.error();
  }
  const auto& [shown, other] = *refined;
  nav::Registration out;
  out.accepted = true;
  out.world_from_vertebra = shown.world_from_vertebra;
  out.rmse_m = shown.rmse_m;
  out.iterations = shown.iterations;
  out.runner_up = other.world_from_vertebra;
  out.runner_up_rmse_m = other.rmse_m;
  out.points = request.points_in_world.size();
  out.predicted_tre_m = std::numeric_limits<double>::infinity();
  return out;
}

Result<nav::Registration> by_pose_search(const RegistrationRequest& request) {
  return nav::register_by_pose_search(request.model, request.points_in_world, options_of(request));
}

Error unknown(const std::string& name) {
  return Error{"--method " + name + ": unknown (available: best, paper)"};
}

}  // namespace

nav::PoseSearchRegistrationOptions options_of(const RegistrationRequest& request) {
  nav::PoseSearchRegistrationOptions options;
  options.common = request.common;
  options.tip_radius_m = request.tip_radius_m;
  options.least_model_sd_m = request.least_model_sd_m;
  options.shafts.assign(request.shafts.begin(), request.shafts.end());
  for (const Timestamp time : request.times) {
    options.times_s.push_back(seconds(time - request.times.front()));
  }
  options.targets = nav::entries_and_targets(request.screws);
  for (const NeighbouringLevel& level : request.neighbours) {
    options.neighbours.push_back({level.label, level.model.get()});
  }
  return options;
}

Result<Registrar> registrar_named(const std::string& name) {
  if (name == "best") {
    return Registrar(&by_pose_search);
  }
  if (name == "paper") {
    return Registrar(&by_paper);
  }
  return unknown(name);
}

Result<Method> method_named(const std::string& name) {
  if (name == "best") {
    return Method{.name = name,
                  .create_tracker = &nav::create_photometric_tracker,
                  .registrar = &by_pose_search,
                  .verification = Verification::kByTouch,
                  .coaching = true,
                  .anchors = true};
  }
  if (name == "paper") {
    return Method{.name = name,
                  .create_tracker = &nav::published::create_corner_tracker,
                  .registrar = &by_paper,
                  .verification = Verification::kByEye,
                  .shows_pattern = true};
  }
  return unknown(name);
}

}  // namespace orthonav::engine
