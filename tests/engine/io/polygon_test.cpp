#include "engine/io/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;

/// Vertices of which a face may be made, behind one of another part.
nav::TriangleMesh flat(const std::vector<Vec3>& places_m) {
  nav::TriangleMesh mesh;
  mesh.vertices_m.push_back({9, 9, 9});
  mesh.vertices_m.insert(mesh.vertices_m.end(), places_m.begin(), places_m.end());
  return mesh;
}

std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> corners(count);
  std::iota(corners.begin(), corners.end(), 0U);
  return corners;
}

/// The area of the triangles that face up, less that of those that face down.
double area_m2(const nav::TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    sum += 0.5 * (mesh.vertices_m[t[1]] - a).cross(mesh.vertices_m[t[2]] - a).z;
  }
  return sum;
}

double whole_m2(const nav::TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    sum += 0.5 * (mesh.vertices_m[t[1]] - a).cross(mesh.vertices_m[t[2]] - a).norm();
  }
  return sum;
}

TEST(AddFace, CutsASquareInTwo) {
  nav::TriangleMesh mesh = flat({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  ASSERT_TRUE(add_face(all_of(4), 1, mesh).ok());
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_NEAR(area_m2(mesh), 1.0, 1e-15);
}

TEST(AddFace, CutsAnArrowheadFromItsNotch) {
  // Whatever corner comes first; from any other but the notch and the tip a triangle is turned.
  const std::vector<Vec3> arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.8, 1, 0}};
  for (std::size_t first = 0; first < 4; ++first) {
    nav::TriangleMesh mesh = flat(arrow);
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      corners.push_back(static_cast<std::uint32_t>((first + i) % 4));
    }
    ASSERT_TRUE(add_face(corners, 1, mesh).ok());
    EXPECT_NEAR(area_m2(mesh), 1.2, 1e-15) << first;
    EXPECT_NEAR(whole_m2(mesh), 1.2, 1e-15) << "no triangle is turned over, from " << first;
  }
}

TEST(AddFace, TakesCornersInALineAndInOneAnother) {
  nav::TriangleMesh mesh = flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 2, 0}});
  ASSERT_TRUE(add_face(all_of(6), 1, mesh).ok());
  EXPECT_NEAR(area_m2(mesh), 4.0, 1e-15);
  nav::TriangleMesh point = flat({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  EXPECT_TRUE(add_face(all_of(4), 1, point).ok());
}

TEST(AddFace, LeavesOutPointsAndLines) {
  nav::TriangleMesh mesh = flat({{0, 0, 0}, {1, 0, 0}});
  EXPECT_TRUE(add_face({}, 1, mesh).ok());
  EXPECT_TRUE(add_face(all_of(2), 1, mesh).ok());
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(AddFace, RefusesWhatNoCornerSeesAllOf) {
  // A comb with two notches.
  nav::TriangleMesh comb = flat(
      {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {6, 1, 0}, {5, 9, 0}, {4, 9, 0}, {3, 1, 0}, {0, 9, 0}});
  const Status refused = add_face(all_of(8), 1, comb);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("a face of 8 corners can't be cut"));
  EXPECT_TRUE(comb.triangles.empty());
}

TEST(AddFace, RefusesVerticesThatAreNotThereAndCornersWithoutEnd) {
  nav::TriangleMesh mesh = flat({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  EXPECT_THAT(add_face(std::vector<std::uint32_t>{0, 1, 3}, 1, mesh).error().message,
              HasSubstr("not there"));
  EXPECT_THAT(add_face(std::vector<std::uint32_t>(65, 0), 1, mesh).error().message,
              HasSubstr("65 corners, at most 64"));
  EXPECT_TRUE(mesh.triangles.empty());
}

}  // namespace
}  // namespace orthonav::engine
