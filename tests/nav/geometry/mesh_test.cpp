#include "nav/geometry/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/random.h"
#include "nav/geometry/triangle.h"
#include "tests/support/allocation_count.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::nav {
namespace {

using test::box;
using test::sphere;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TriangleMesh vertebra_sized_box() { return box({-0.04, -0.03, -0.02}, {0.04, 0.05, 0.02}); }

double volume_m3(const TriangleMesh& mesh) {
  double v = 0.0;
  for (const auto& t : mesh.triangles) {
    v += mesh.vertices_m[t[0]].dot(mesh.vertices_m[t[1]].cross(mesh.vertices_m[t[2]])) / 6.0;
  }
  return v;
}

std::string refusal(TriangleMesh mesh) {
  const auto checked = checked_vertebra(std::move(mesh));
  return checked ? "accepted" : checked.error().message;
}

TEST(CheckedVertebra, TakesAClosedMeshAsItIs) {
  const TriangleMesh mesh = vertebra_sized_box();
  const auto checked = checked_vertebra(mesh);
  ASSERT_TRUE(checked.ok());
  EXPECT_EQ(checked->triangles, mesh.triangles);
  EXPECT_EQ(checked->vertices_m, mesh.vertices_m);
}

TEST(CheckedVertebra, TurnsAnInwardMesh) {
  TriangleMesh mesh = vertebra_sized_box();
  for (auto& t : mesh.triangles) {
    std::swap(t[0], t[1]);
  }
  ASSERT_LT(volume_m3(mesh), 0.0);
  const auto checked = checked_vertebra(mesh);
  ASSERT_TRUE(checked.ok());
  EXPECT_NEAR(volume_m3(*checked), 0.08 * 0.08 * 0.04, 1e-12);
}

TEST(CheckedVertebra, RefusesAMeshWithoutFaces) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles.clear();
  EXPECT_THAT(refusal(mesh), HasSubstr("no faces"));
  EXPECT_THAT(refusal({}), HasSubstr("no faces"));
}

TEST(CheckedVertebra, RefusesVerticesThatAreNotFinite) {
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = vertebra_sized_box();
    mesh.vertices_m[5].y = bad;
    EXPECT_THAT(refusal(mesh), HasSubstr("vertex 5 is not finite"));
  }
}

TEST(CheckedVertebra, RefusesIndicesOutOfRange) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles[3][1] = 8;
  EXPECT_THAT(refusal(mesh), HasSubstr("face 3 names vertex 8, but there are only 8"));
}

TEST(CheckedVertebra, RefusesAFaceWithOneVertexTwice) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles.push_back({2, 2, 3});
  EXPECT_THAT(refusal(mesh), HasSubstr("face 12 names vertex 2 twice"));
}

TEST(CheckedVertebra, RefusesAnOpenMesh) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.triangles.pop_back();
  EXPECT_THAT(refusal(mesh), HasSubstr("mesh is open: 3 edges"));
}

TEST(CheckedVertebra, RefusesAnEdgeWithMoreThanTwoFaces) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.vertices_m.push_back({0, 0, 0.05});  // a fin: both of its sides on one edge of the box
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({1, 0, 8});
  EXPECT_THAT(refusal(mesh), HasSubstr("1 edges have more than two faces"));
}

TEST(CheckedVertebra, RefusesFacesWoundAgainstEachOther) {
  TriangleMesh mesh = vertebra_sized_box();
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_THAT(refusal(mesh), HasSubstr("wound against each other"));
}

TEST(CheckedVertebra, RefusesAMeshWithoutInside) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {0.06, 0, 0}, {0, 0.06, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_THAT(refusal(mesh), HasSubstr("encloses no volume"));
}

TEST(CheckedVertebra, NamesMetresTakenForMillimetres) {
  TriangleMesh mesh = vertebra_sized_box();
  for (Vec3& v : mesh.vertices_m) {
    v = v * 1e-3;
  }
  EXPECT_THAT(refusal(mesh), HasSubstr("mesh is 0.08 mm across, limit 30-250 mm"));
  EXPECT_THAT(refusal(mesh), HasSubstr("metres taken for millimetres"));
  for (Vec3& v : mesh.vertices_m) {
    v = v * 1e6;
  }
  EXPECT_THAT(refusal(mesh), HasSubstr("millimetres taken for metres"));
}

TEST(CheckedVertebra, HoldsTheLimitsOfSizeToTheMillimetre) {
  EXPECT_EQ(refusal(box({0, 0, 0}, {0.0301, 0.02, 0.02})), "accepted");
  EXPECT_THAT(refusal(box({0, 0, 0}, {0.0299, 0.02, 0.02})), HasSubstr("29.9 mm across"));
  EXPECT_EQ(refusal(box({0, 0, 0}, {0.2499, 0.1, 0.1})), "accepted");
  EXPECT_THAT(refusal(box({0, 0, 0}, {0.2501, 0.1, 0.1})), HasSubstr("250.1 mm across"));
}

TEST(Welded, JoinsTheCornersOfALooseMesh) {
  const TriangleMesh whole = vertebra_sized_box();
  TriangleMesh loose;
  for (const auto& t : whole.triangles) {
    const auto base = static_cast<std::uint32_t>(loose.vertices_m.size());
    for (const std::uint32_t v : t) {
      loose.vertices_m.push_back(whole.vertices_m[v]);
    }
    loose.triangles.push_back({base, base + 1, base + 2});
  }
  EXPECT_THAT(refusal(loose), HasSubstr("open"));
  const TriangleMesh joined = welded(loose);
  EXPECT_EQ(joined.vertices_m.size(), 8U);
  EXPECT_EQ(joined.triangles.size(), 12U);
  EXPECT_EQ(refusal(joined), "accepted");
}

TEST(Welded, LeavesOutCollapsedFacesAndKeepsWrongIndicesWrong) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.vertices_m.push_back(mesh.vertices_m[3]);
  mesh.triangles.push_back({3, 8, 1});
  EXPECT_EQ(welded(mesh).triangles.size(), 12U);
  mesh.triangles.push_back({0, 77, 99});
  EXPECT_THAT(refusal(welded(mesh)), HasSubstr("face 12 names vertex"));
}

/// The answer without an index.
SurfacePoint nearest_of_all(const TriangleMesh& mesh, Vec3 query_m) {
  SurfacePoint best{{}, {}, 1e9, 0};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Triangle corners{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
    const Vec3 p = nearest_on_triangle(query_m, corners);
    if ((p - query_m).norm() < best.distance_m) {
      best = {p, triangle_normal(corners), (p - query_m).norm(), i};
    }
  }
  return best;
}

/// A bumpy closed surface, so that nothing is symmetric.
TriangleMesh potato() {
  TriangleMesh mesh = sphere({0.01, 0.02, -0.01}, 0.04, 18);
  Random random(5);
  for (Vec3& v : mesh.vertices_m) {
    v = v + 0.003 * Vec3{random.normal(), random.normal(), 0.4};
  }
  return mesh;
}

Vec3 somewhere(Random& random, double reach_m) {
  return {random.uniform(-reach_m, reach_m), random.uniform(-reach_m, reach_m),
          random.uniform(-reach_m, reach_m)};
}

TEST(SurfaceIndex, FindsTheSameNearestPointAsTryingEveryTriangle) {
  const TriangleMesh mesh = potato();
  const SurfaceIndex index(mesh);
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 query_m = somewhere(random, i % 2 == 0 ? 0.06 : 0.5);
    const SurfacePoint expected = nearest_of_all(mesh, query_m);
    const auto found = index.nearest(query_m);
    ASSERT_TRUE(found);
    // Edges are shared: the triangle may differ, the distance may not.
    ASSERT_NEAR(found->distance_m, expected.distance_m, 1e-15) << i;
    ASSERT_LT((found->point_m - expected.point_m).norm(), 1e-9) << i;
  }
}

TEST(SurfaceIndex, LooksNoFartherThanAsked) {
  const SurfaceIndex index(vertebra_sized_box());
  const Vec3 query_m{0.05, 0, 0};  // 10 mm beside the box
  EXPECT_TRUE(index.nearest(query_m, 0.0101));
  EXPECT_FALSE(index.nearest(query_m, 0.0099));
}

TEST(SurfaceIndex, MeetsTheSameFirstTriangleAsTryingEveryOne) {
  const TriangleMesh mesh = potato();
  const SurfaceIndex index(mesh);
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 origin_m = somewhere(random, 0.08);
    const Vec3 direction = somewhere(random, 7.0);
    double expected = 1e9;
    for (const auto& t : mesh.triangles) {
      if (const auto s = ray_meets_triangle(
              origin_m, direction,
              {mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]})) {
        expected = std::min(expected, *s * direction.norm());
      }
    }
    const auto found = index.first_hit(origin_m, direction);
    ASSERT_EQ(found.has_value(), expected < 1e9) << i;
    if (!found) {
      continue;
    }
    ++hits;
    ASSERT_NEAR(found->distance_m, expected, 1e-12) << i;
  }
  EXPECT_GT(hits, 200);
  EXPECT_LT(hits, 1900);
}

TEST(SurfaceIndex, HitsAlongTheAxesAndThroughEdgesAndCorners) {
  const SurfaceIndex index(box({0, 0, 0}, {0.04, 0.04, 0.04}));
  const auto face = index.first_hit({0.01, 0.02, 0.1}, {0, 0, -2});
  ASSERT_TRUE(face);
  EXPECT_NEAR(face->distance_m, 0.06, 1e-15);
  EXPECT_EQ(face->normal, (Vec3{0, 0, 1}));
  EXPECT_TRUE(index.first_hit({0.02, 0.02, 0.1}, {0, 0, -1}));  // the face's diagonal
  EXPECT_TRUE(index.first_hit({0.1, 0.1, 0.1}, {-1, -1, -1}));  // the corner
  EXPECT_FALSE(index.first_hit({0.01, 0.02, 0.1}, {0, 0, 1}));
  EXPECT_FALSE(index.first_hit({0.041, 0.02, 0.1}, {0, 0, -1}));
}

TEST(SurfaceIndex, KnowsInsideFromOutside) {
  const Vec3 centre{0.01, 0.02, -0.01};
  const SurfaceIndex index(sphere(centre, 0.04, 24));
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 offset = somewhere(random, 0.05);
    // Between the flat triangles' and the sphere's radius either answer is right.
    if (offset.norm() > 0.0395 && offset.norm() < 0.0401) {
      continue;
    }
    ASSERT_EQ(index.contains(centre + offset), offset.norm() < 0.04) << i;
  }
}

TEST(SurfaceIndex, AnswersNoWhereThereIsNothingToAsk) {
  const SurfaceIndex empty{TriangleMesh{}};
  EXPECT_FALSE(empty.nearest({0, 0, 0}));
  EXPECT_FALSE(empty.first_hit({0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(empty.contains({0, 0, 0}));
  const SurfaceIndex index(vertebra_sized_box());
  EXPECT_FALSE(index.nearest({kNaN, 0, 0}));
  EXPECT_FALSE(index.nearest({0, 0, 0}, kNaN));
  EXPECT_FALSE(index.first_hit({0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(index.first_hit({0, 0, 0}, {0, kNaN, 0}));
  EXPECT_FALSE(index.first_hit({0, kNaN, 0}, {1, 0, 0}));
}

TEST(SurfaceIndex, AllocatesNothingInQueries) {
  const SurfaceIndex index(potato());
  const auto before = orthonav::test::allocation_count();
  for (int i = 0; i < 100; ++i) {
    const Vec3 q{0.001 * i, 0.02, -0.03};
    EXPECT_TRUE(index.nearest(q).has_value());
    static_cast<void>(index.first_hit(q, {0, 0, 1}));
    static_cast<void>(index.contains(q));
  }
  EXPECT_EQ(orthonav::test::allocation_count(), before);
}

TEST(SurfaceIndex, SurvivesTrianglesWithoutArea) {
  TriangleMesh mesh = vertebra_sized_box();
  mesh.vertices_m.push_back({0, 0, 0.06});
  mesh.triangles.push_back({8, 8, 8});
  mesh.vertices_m.push_back({0, 0.01, 0.06});
  mesh.triangles.push_back({8, 9, 8});
  const auto found = SurfaceIndex(mesh).nearest({0, 0.005, 0.061});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance_m, 0.001, 1e-12);
}

}  // namespace
}  // namespace orthonav::nav
