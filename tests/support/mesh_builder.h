#pragma once

#include "nav/geometry/mesh.h"

namespace orthonav::test {

/// A closed, outward-oriented box from `low` to `high`: 8 vertices, 12 triangles.
inline nav::TriangleMesh box(Vec3 low, Vec3 high) {
  nav::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_m.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                               (i & 4) != 0 ? high.z : low.z});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline nav::TriangleMesh vertebra_sized_box() {
  return box({-0.04, -0.03, -0.02}, {0.04, 0.05, 0.02});
}

/// The mesh turned about the origin.
inline nav::TriangleMesh rotated(nav::TriangleMesh mesh, const Mat3& rotation) {
  for (Vec3& v : mesh.vertices_m) {
    v = rotation * v;
  }
  return mesh;
}

/// A closed, outward-oriented sphere of `rings` bands.
nav::TriangleMesh sphere(Vec3 centre, double radius_m, std::uint32_t rings);

}  // namespace orthonav::test
