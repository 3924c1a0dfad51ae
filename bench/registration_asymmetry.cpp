#include "bench/registration_asymmetry.h"

#include <cmath>
#include <vector>

#include "nav/registration/search.h"

namespace orthonav::bench {
double asymmetry_m(const nav::VertebraModel& model) {
  constexpr int kRounds = 5;
  const Vec3 centre_m = model.reachable_axes().centre_m;
  std::vector<Point<World>> mirrored;
  for (const Vec3& v : model.reachable().vertices_m) {
    mirrored.push_back({{2.0 * centre_m.x - v.x, v.y, v.z}});
  }
  nav::FoundPose found =
      nav::refined_pose(model.search_field(), mirrored, nav::poses_beside(centre_m), 0.0);
  for (int round = 1; round < kRounds; ++round) {
    const std::vector from_there{found.world_from_vertebra};
    found = nav::refined_pose(model.search_field(), mirrored, from_there, 0.0);
  }
  return std::sqrt(found.cost_m2);
}

}  // namespace orthonav::bench
