#include "base/vertex_normals.h"

#include <gtest/gtest.h>

namespace orthonav {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A handful of products and sums of numbers below 10.
constexpr double kNormalRounding = 1e-14;

/// The corner of a box of 1 by 2 by 3, seen from outside; the last vertex belongs to no triangle.
const std::vector<Vec3> kCorner_m = {{0, 0, 0}, {-1, 0, 0}, {0, -2, 0}, {0, 0, -3}, {5, 5, 5}};
const Triangles kSides = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};

TEST(VertexAreas, AreTwiceThoseOfTheTrianglesAroundAVertex) {
  const std::vector<Vec3> areas_m2 = vertex_areas_m2(kCorner_m, kSides);
  ASSERT_EQ(areas_m2.size(), kCorner_m.size());
  EXPECT_EQ(areas_m2[0], (Vec3{6, 3, 2}));
  EXPECT_EQ(areas_m2[1], (Vec3{0, 3, 2}));
  EXPECT_EQ(areas_m2[2], (Vec3{6, 0, 2}));
  EXPECT_EQ(areas_m2[3], (Vec3{6, 3, 0}));
}

TEST(VertexNormals, AreTheMeanByAreaAndOfUnitLength) {
  const std::vector<Vec3> normals = vertex_normals(kCorner_m, kSides);
  ASSERT_EQ(normals.size(), kCorner_m.size());
  // Not (1, 1, 1) / sqrt(3), the result if all three sides had equal weight.
  EXPECT_LT((normals[0] - Vec3{6.0 / 7.0, 3.0 / 7.0, 2.0 / 7.0}).norm(), kNormalRounding);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(normals[i].norm(), 1.0, kNormalRounding) << i;
  }
}

TEST(VertexNormals, PointInwardWhereTrianglesRunTheOtherWay) {
  Triangles inward = kSides;
  for (auto& triangle : inward) {
    std::swap(triangle[1], triangle[2]);
  }
  EXPECT_EQ(vertex_normals(kCorner_m, inward)[0], -vertex_normals(kCorner_m, kSides)[0]);
}

TEST(VertexNormals, AreZeroWhereNothingHasAnArea) {
  EXPECT_EQ(vertex_normals(kCorner_m, kSides)[4], Vec3{}) << "of no triangle";
  const Triangles line = {{0, 1, 1}};
  EXPECT_EQ(vertex_normals(kCorner_m, line)[0], Vec3{}) << "collapsed";
  EXPECT_TRUE(vertex_normals({}, {}).empty());
}

}  // namespace
}  // namespace orthonav
