#include "bench/registration_asymmetry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nav/registration/search.h"

namespace orthonav::bench {
namespace {

constexpr std::size_t kMaxVertices = 1500;
constexpr double kFarthest_m = 0.005;

/// The unchanged pose, and poses turned and shifted to every side, since the best start is unknown.
std::vector<nav::CentredPose> starts(Vec3 centre_m) {
  constexpr double kRotation_rad = 0.15;
  constexpr double kAside_m = 0.003;
  std::vector<nav::CentredPose> out{{Mat3::identity(), centre_m}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 along;
      along[axis] = side;
      out.push_back({rotation_from_vector(kRotation_rad * along), centre_m});
      out.push_back({Mat3::identity(), centre_m + kAside_m * along});
    }
  }
  return out;
}

}  // namespace

double asymmetry_m(const nav::VertebraModel& model) {
  const auto& vertices_m = model.reachable().vertices_m;
  const std::size_t step = std::max<std::size_t>(1, vertices_m.size() / kMaxVertices);
  const Vec3 centre_m = model.reachable_axes().centre_m;
  std::vector<Vec3> points_m;
  for (std::size_t i = 0; i < vertices_m.size(); i += step) {
    const Vec3 p = vertices_m[i] - centre_m;
    points_m.push_back({-p.x, p.y, p.z});
  }
  nav::SurfaceFitOptions options;
  options.max_iterations = 40;
  options.farthest_m = kFarthest_m;
  double least_m = std::numeric_limits<double>::infinity();
  for (const nav::CentredPose& start : starts(centre_m)) {
    const auto fit = nav::fit_to_surface(model.reachable_surface(), points_m, start, options);
    if (fit) {
      least_m = std::min(least_m, std::sqrt(nav::truncated_cost_m2(*fit, kFarthest_m)));
    }
  }
  return least_m;
}

}  // namespace orthonav::bench
