#pragma once

#include <string>

#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// A box of 80 × 60 × 40 mm (within the sizes of vertebrae), closed, outward-oriented, metres.
inline nav::TriangleMesh box_mesh() {
  nav::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_m.push_back(
        {(i & 1 ? 0.04 : -0.04), (i & 2 ? 0.03 : -0.03), (i & 4 ? 0.02 : -0.02)});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// The same as OBJ text, in the unit that has `units_per_metre`.
inline std::string as_obj(const nav::TriangleMesh& mesh, double units_per_metre) {
  std::string text = "# test\n";
  for (const Vec3& v : mesh.vertices_m) {
    const Vec3 u = v * units_per_metre;
    text +=
        "v " + std::to_string(u.x) + " " + std::to_string(u.y) + " " + std::to_string(u.z) + "\n";
  }
  for (const auto& t : mesh.triangles) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
            std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

/// Six times the enclosed volume is the sum of the corners' determinants.
inline double volume_m3(const nav::TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    sum += mesh.vertices_m[t[0]].dot(mesh.vertices_m[t[1]].cross(mesh.vertices_m[t[2]]));
  }
  return sum / 6.0;
}

}  // namespace orthonav::engine
