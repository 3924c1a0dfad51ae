#include "base/vertex_normals.h"

namespace orthonav {

std::vector<Vec3> vertex_areas_m2(std::span<const Vec3> vertices_m,
                                  std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Vec3> areas_m2(vertices_m.size());
  for (const auto& triangle : triangles) {
    const Vec3 a = vertices_m[triangle[0]];
    const Vec3 area_m2 = (vertices_m[triangle[1]] - a).cross(vertices_m[triangle[2]] - a);
    for (const std::uint32_t corner : triangle) {
      areas_m2[corner] += area_m2;
    }
  }
  return areas_m2;
}

std::vector<Vec3> vertex_normals(std::span<const Vec3> vertices_m,
                                 std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Vec3> normals = vertex_areas_m2(vertices_m, triangles);
  for (Vec3& normal : normals) {
    normal = normal.norm() > 0.0 ? normal.normalized() : Vec3{};
  }
  return normals;
}

}  // namespace orthonav
