#include "nav/registration/unstroked_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace orthonav::nav {
namespace {

constexpr double kStroked_m = 0.004;
constexpr double kUnstroked_m = 0.006;
/// Only one of several points closer together than this is used; the limits move by no more than
/// that.
constexpr double kThinned_m = 0.0005;

std::vector<Vec3> thinned(const Transform<Vertebra, World>& vertebra_from_world,
                          std::span<const Point<World>> points) {
  std::map<std::array<int, 3>, Vec3> cells;
  const auto cell = [](double x) { return static_cast<int>(std::floor(x / kThinned_m)); };
  for (const Point<World>& point : points) {
    const Vec3 at = (vertebra_from_world * point).v;
    if (!std::isfinite(at.x + at.y + at.z)) {
      continue;
    }
    cells.try_emplace({cell(at.x), cell(at.y), cell(at.z)}, at);
  }
  std::vector<Vec3> kept;
  for (const auto& [key, at] : cells) {
    kept.push_back(at);
  }
  return kept;
}

float unstroked_fraction(Vec3 place_m, const std::vector<Vec3>& points_m) {
  double least_m2 = kUnstroked_m * kUnstroked_m;
  for (const Vec3 point : points_m) {
    least_m2 = std::min(least_m2, (point - place_m).squared_norm());
    if (least_m2 <= kStroked_m * kStroked_m) {
      return 0.0f;
    }
  }
  return static_cast<float>((std::sqrt(least_m2) - kStroked_m) / (kUnstroked_m - kStroked_m));
}

}  // namespace

std::vector<float> unstroked_surface(const VertebraModel& model,
                                     const Transform<World, Vertebra>& world_from_vertebra,
                                     std::span<const Point<World>> points) {
  const std::vector<Vec3> stroked_m = thinned(world_from_vertebra.inverse(), points);
  const TriangleMesh& mesh = model.mesh();
  constexpr float kNotAsked = -1.0f;
  std::vector<float> unstroked(mesh.vertices_m.size(), kNotAsked);
  for (const std::uint32_t face : model.reachable_faces()) {
    for (const std::uint32_t vertex : mesh.triangles[face]) {
      if (unstroked[vertex] == kNotAsked) {
        unstroked[vertex] = unstroked_fraction(mesh.vertices_m[vertex], stroked_m);
      }
    }
  }
  std::replace(unstroked.begin(), unstroked.end(), kNotAsked, 0.0f);
  return unstroked;
}

}  // namespace orthonav::nav
