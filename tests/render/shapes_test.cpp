#include "render/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "render/float3.h"

namespace orthonav::render::shapes_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Volume inside a closed surface; negative when it is turned inside out.
double volume_of(const MeshData& mesh) {
  double six_volumes = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Float3 a = mesh.positions[mesh.indices[t]];
    const Float3 b = mesh.positions[mesh.indices[t + 1]];
    const Float3 c = mesh.positions[mesh.indices[t + 2]];
    six_volumes += dot(a, cross(b, c));
  }
  return six_volumes / 6;
}

/// Every edge between two places is walked once each way.
bool is_closed(const MeshData& mesh) {
  std::map<std::array<float, 6>, int> walked;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Float3 a = mesh.positions[mesh.indices[t + k]];
      const Float3 b = mesh.positions[mesh.indices[t + (k + 1) % 3]];
      if (a == b) {
        continue;  // of a triangle at a pole
      }
      ++walked[{a.x, a.y, a.z, b.x, b.y, b.z}];
      --walked[{b.x, b.y, b.z, a.x, a.y, a.z}];
    }
  }
  for (const auto& [edge, balance] : walked) {
    if (balance != 0) {
      return false;
    }
  }
  return !walked.empty();
}

TEST(Sphere, IsClosedOutwardAndAsLargeAsTold) {
  const MeshData sphere = make_sphere(0.002f, 48, 24);
  EXPECT_TRUE(is_closed(sphere));
  const double exact = 4.0 / 3.0 * std::numbers::pi * 8e-9;
  // 48 facets around lose 0.3 % of the section, 24 along 0.5 %.
  EXPECT_NEAR(volume_of(sphere) / exact, 0.99, 0.01);
  for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
    EXPECT_NEAR(length(sphere.positions[i]), 0.002f, 1e-8f);
    EXPECT_NEAR(dot(sphere.normals[i], sphere.positions[i]), 0.002f, 1e-8f);
  }
}

TEST(Cylinder, IsClosedOutwardAndAsLargeAsTold) {
  const MeshData cylinder = make_cylinder({0.01f, 0, 0}, {0.01f, 0.05f, 0}, 0.003f, 48);
  EXPECT_TRUE(is_closed(cylinder));
  EXPECT_NEAR(volume_of(cylinder) / (std::numbers::pi * 9e-6 * 0.05), 1.0, 0.004);
}

TEST(Tube, KeepsItsSectionAroundABend) {
  std::vector<Float3> path;
  for (int i = 0; i <= 60; ++i) {
    const float angle_rad = static_cast<float>(i) / 60 * std::numbers::pi_v<float>;
    path.push_back({0.05f * std::cos(angle_rad), 0.05f * std::sin(angle_rad), 0.01f * angle_rad});
  }
  const MeshData tube = make_tube(path, 0.00275f, 32);
  EXPECT_TRUE(is_closed(tube));
  double run_m = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    run_m += length(path[i] - path[i - 1]);
  }
  const double section = std::numbers::pi * 0.00275 * 0.00275;
  EXPECT_NEAR(volume_of(tube) / (section * run_m), 1.0, 0.01);
}

TEST(Tube, HasNothingToShowWithoutAPath) {
  EXPECT_TRUE(make_tube({}, 0.001f).indices.empty());
  const std::vector<Float3> twice = {{1, 2, 3}, {1, 2, 3}};
  EXPECT_TRUE(make_tube(twice, 0.001f).indices.empty());
  const std::vector<Float3> bad = {{1, 2, 3}, {kNaN, 2, 3}, {2, 2, 2}};
  EXPECT_TRUE(make_tube(bad, 0.001f).indices.empty());
  EXPECT_TRUE(make_cylinder({0, 0, 0}, {1, 0, 0}, 0).indices.empty());
  EXPECT_TRUE(make_sphere(kNaN).indices.empty());
  EXPECT_TRUE(make_ring({0, 0, kNaN}, {0, 1, 0}, 0.01f).empty());
}

TEST(Ring, LiesInItsPlaneAtItsRadius) {
  const Float3 centre = {0.1f, 0.2f, 0.3f};
  const Float3 normal = unit_or({1, 2, -1}, {});
  for (const Float3 point : make_ring(centre, 3.0f * normal, 0.006f)) {
    EXPECT_NEAR(length(point - centre), 0.006f, 1e-7f);
    EXPECT_NEAR(dot(point - centre, normal), 0, 1e-7f);
  }
}

TEST(SmoothNormals, OfAFlatSheetStandOnIt) {
  const std::vector<Float3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3, 0, 1, 77};
  const std::vector<Float3> normals = smooth_normals(corners, indices);
  ASSERT_EQ(normals.size(), 5u);
  for (const Float3 normal : normals) {
    EXPECT_EQ(normal, (Float3{0, 0, 1}));
  }
}

}  // namespace
}  // namespace orthonav::render::shapes_test
