#include "tests/support/mesh_builder.h"

#include <cmath>
#include <numbers>

namespace orthonav::test {

nav::TriangleMesh sphere(Vec3 centre, double radius_m, std::uint32_t rings) {
  nav::TriangleMesh mesh;
  const std::uint32_t sides = 2 * rings;
  mesh.vertices_m = {centre + Vec3{0, 0, radius_m}, centre - Vec3{0, 0, radius_m}};
  for (std::uint32_t ring = 1; ring < rings; ++ring) {
    for (std::uint32_t side = 0; side < sides; ++side) {
      const double polar = std::numbers::pi * ring / rings;
      const double around = 2.0 * std::numbers::pi * side / sides;
      mesh.vertices_m.push_back(centre + radius_m * Vec3{std::sin(polar) * std::cos(around),
                                                         std::sin(polar) * std::sin(around),
                                                         std::cos(polar)});
    }
  }
  const auto at = [&](std::uint32_t ring, std::uint32_t side) {
    return 2 + (ring - 1) * sides + side % sides;
  };
  for (std::uint32_t side = 0; side < sides; ++side) {
    mesh.triangles.push_back({0, at(1, side), at(1, side + 1)});
    mesh.triangles.push_back({1, at(rings - 1, side + 1), at(rings - 1, side)});
    for (std::uint32_t ring = 1; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({at(ring, side), at(ring + 1, side), at(ring + 1, side + 1)});
      mesh.triangles.push_back({at(ring, side), at(ring + 1, side + 1), at(ring, side + 1)});
    }
  }
  return mesh;
}

}  // namespace orthonav::test
