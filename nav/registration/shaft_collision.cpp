#include "nav/registration/shaft_collision.h"

#include <algorithm>

#include "nav/registration/pose_search.h"

namespace orthonav::nav {
namespace {

/// The first millimetres of the shaft are left out: they may graze the bone that the tip touches.
constexpr double kFrom_m = 0.006;
constexpr double kTo_m = 0.060;
constexpr double kStep_m = 0.003;
/// Shafts have a width, and poses and fields have errors: only depths beyond this count.
constexpr double kInside_m = 0.002;
constexpr std::size_t kShaftsChecked = 300;

bool goes_through(const DistanceField& field, Vec3 tip, Vec3 shaft) {
  DistanceField::Value value;
  for (double along = kFrom_m; along < kTo_m; along += kStep_m) {
    if (field.at(tip + along * shaft, value) && value.distance_m < -kInside_m) {
      return true;
    }
  }
  return false;
}

}  // namespace

double shaft_collision_fraction(const VertebraModel& model,
                                const Transform<World, Vertebra>& world_from_vertebra,
                                std::span<const Point<World>> points,
                                std::span<const Vec3> shafts_in_world) {
  const DistanceField& field = model.search_field().field();
  const Transform<Vertebra, World> vertebra_from_world = world_from_vertebra.inverse();
  const std::size_t n = std::min(points.size(), shafts_in_world.size());
  const std::size_t step = std::max<std::size_t>(1, n / kShaftsChecked);
  double looked_at = 0.0;
  double through = 0.0;
  for (std::size_t i = 0; i < n; i += step) {
    if (!(shafts_in_world[i].squared_norm() > 0.5)) {
      continue;
    }
    looked_at += 1.0;
    const Vec3 shaft = vertebra_from_world.rotation() * shafts_in_world[i];
    if (goes_through(field, (vertebra_from_world * points[i]).v, shaft)) {
      through += 1.0;
    }
  }
  return looked_at > 0.0 ? through / looked_at : 0.0;
}

}  // namespace orthonav::nav
