#include "bench/registration_asymmetry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nav/registration/search.h"

namespace orthonav::bench {
namespace {

/// The unchanged pose, and poses turned and shifted to every side, since the best start is unknown.
std::vector<Transform<World, Vertebra>> starts(Vec3 centre_m) {
  constexpr double kTurned_rad = 0.15;
  constexpr double kAside_m = 0.003;
  std::vector<Transform<World, Vertebra>> out(1);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 along;
      along[axis] = side;
      const Mat3 turned = rotation_from_vector(kTurned_rad * along);
      out.push_back({turned, centre_m - turned * centre_m});
      out.push_back({Mat3::identity(), kAside_m * along});
    }
  }
  return out;
}

}  // namespace

double asymmetry_m(const nav::VertebraModel& model) {
  constexpr int kRounds = 5;
  const Vec3 centre_m = model.reachable_axes().centre_m;
  std::vector<Point<World>> mirrored;
  for (const Vec3& v : model.reachable().vertices_m) {
    mirrored.push_back({{2.0 * centre_m.x - v.x, v.y, v.z}});
  }
  double least_m2 = std::numeric_limits<double>::infinity();
  for (const Transform<World, Vertebra>& start : starts(centre_m)) {
    nav::FoundPose found{start, 0.0};
    for (int round = 0; round < kRounds; ++round) {
      found = nav::refined_pose(model.search_field(), mirrored, found.world_from_vertebra, 0.0);
    }
    least_m2 = std::min(least_m2, found.cost_m2);
  }
  return std::sqrt(least_m2);
}

}  // namespace orthonav::bench
