#pragma once

#include <array>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "engine/report/registration_figures.h"

namespace orthonav::engine {

/// Errs by 0.1, 0.2 and 0.3 mm along the axes of the model, the same everywhere.
inline nav::PoseUncertainty translation_only() {
  std::array<double, 36> covariance{};
  covariance[0] = 0.1e-3 * 0.1e-3;
  covariance[7] = 0.2e-3 * 0.2e-3;
  covariance[14] = 0.3e-3 * 0.3e-3;
  return {{}, covariance};
}

/// Points on the phantom itself, and one 8 mm behind it: no noise, one outlier.
inline RegisteredLevel exact() {
  static const OperatedLevel kLevel =
      plan_operation(phantom({"L4"}), {"L4"}).value().levels.front();
  RegisteredLevel level;
  level.label = "L4";
  level.method = "best";
  level.model = kLevel.model;
  level.screws = kLevel.screws;
  level.registration.accepted = true;
  level.registration.world_from_vertebra = {rotation_from_vector({0.3, 0.1, -2.0}), {1, 2, 3}};
  level.registration.runner_up = level.registration.world_from_vertebra;
  level.registration.noise_m = 0.0002;
  level.registration.uncertainty = translation_only();
  const auto& vertices = level.model->reachable().vertices_m;
  for (std::size_t i = 0; i < vertices.size(); i += 5) {
    level.points.push_back(level.registration.world_from_vertebra * Point<Vertebra>{vertices[i]});
  }
  Vec3 hindmost = vertices.front();
  for (const Vec3& v : vertices) {
    if (v.y > hindmost.y) {
      hindmost = v;
    }
  }
  level.points.push_back(level.registration.world_from_vertebra *
                         Point<Vertebra>{hindmost + Vec3{0, 0.008, 0}});
  level.registration.points = level.points.size();
  return level;
}

}  // namespace orthonav::engine
