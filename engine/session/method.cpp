#include "engine/session/method.h"

#include "nav/guidance/predicted_error.h"

namespace orthonav::engine {
namespace {

Result<nav::Registration> by_paper(const RegistrationRequest& request) {
  return nav::register_by_principal_axes(request.model, request.points_in_world);
}

Result<nav::Registration> by_pose_search(const RegistrationRequest& request) {
  nav::PoseSearchRegistrationOptions options;
  options.common = request.common;
  options.tip_radius_m = request.tip_radius_m;
  options.point_sd_m.assign(request.point_sd_m.begin(), request.point_sd_m.end());
  options.shafts.assign(request.shafts.begin(), request.shafts.end());
  options.targets = nav::entries_and_targets(request.screws);
  for (const NeighbouringLevel& level : request.neighbours) {
    options.neighbours.push_back({level.label, level.model.get()});
  }
  return nav::register_by_pose_search(request.model, request.points_in_world, options);
}

Error unknown(const std::string& name) {
  return Error{"--method " + name + ": unknown (available: best, paper)"};
}

}  // namespace

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
    return Method{
        name, &nav::create_photometric_tracker, &by_pose_search, Verification::kByTouch, true,
        true};
  }
  if (name == "paper") {
    return Method{name, &nav::create_corner_tracker, &by_paper, Verification::kByEye, false, false};
  }
  return unknown(name);
}

}  // namespace orthonav::engine
