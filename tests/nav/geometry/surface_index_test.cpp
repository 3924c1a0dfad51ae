#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "nav/geometry/box_tree.h"
#include "nav/geometry/mesh.h"
#include "nav/geometry/triangle.h"
#include "tests/support/allocation_count.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::nav {
namespace {

using test::box;
using test::sphere;
using test::vertebra_sized_box;

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

/// The distance without an index; 1e9 where nothing is hit.
double first_hit_of_all(const TriangleMesh& mesh, Vec3 origin_m, Vec3 direction) {
  double first_m = 1e9;
  for (const auto& t : mesh.triangles) {
    const Triangle corners{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
    if (const auto s = ray_meets_triangle(origin_m, direction, corners)) {
      first_m = std::min(first_m, *s * direction.norm());
    }
  }
  return first_m;
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

/// Corners at random, so that triangles overlap as those of no bone do.
std::vector<Triangle> scattered_triangles(std::size_t count, Vec3 about_m) {
  Random random(count);
  std::vector<Triangle> triangles(count);
  for (Triangle& t : triangles) {
    const Vec3 centre_m = about_m + somewhere(random, 0.05);
    for (Vec3& v : t) {
      v = centre_m + somewhere(random, 0.005);
    }
  }
  return triangles;
}

TriangleMesh loose(const std::vector<Triangle>& triangles) {
  TriangleMesh mesh;
  for (const Triangle& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.insert(mesh.vertices_m.end(), t.begin(), t.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(BoxTree, HoldsEachTriangleOnceInBoxesThatSurroundIt) {
  for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 64U, 65U, 600U}) {
    const std::vector<Triangle> triangles = scattered_triangles(count, {0.3, -0.2, 0.1});
    std::vector<std::uint32_t> order;
    const BoxTree tree(triangles, order);
    ASSERT_EQ(tree.empty(), count == 0);
    std::vector<int> seen(count, 0);
    for (const BoxTree::Node& node : tree.nodes()) {
      for (std::size_t lane = 0; lane < node.count; ++lane) {
        if ((node.child[lane] & BoxTree::kTriangle) == 0) {
          continue;
        }
        const std::uint32_t i = order[node.child[lane] & ~BoxTree::kTriangle];
        ++seen[i];
        for (const Vec3& v : triangles[i]) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const double off = v[static_cast<int>(axis)] - node.centre[axis][lane];
            EXPECT_LE(std::abs(off), node.half[axis][lane]);
          }
        }
      }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(count));
  }
}

TEST(BoxTree, NeedsNoMoreNodesThanTrianglesFill) {
  std::vector<std::uint32_t> order;
  EXPECT_EQ(BoxTree(scattered_triangles(64, {}), order).nodes().size(), 9U);
  EXPECT_EQ(BoxTree(scattered_triangles(512, {}), order).nodes().size(), 73U);
}

/// Boxes are in single precision: a kilometre away their corners are 0.1 mm apart.
TEST(SurfaceIndex, IsAsExactFarFromTheOrigin) {
  const Vec3 far_m{1000.0, -2000.0, 500.0};
  const TriangleMesh mesh = loose(scattered_triangles(300, far_m));
  const SurfaceIndex index(mesh);
  Random random(7);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 query_m = far_m + somewhere(random, 0.06);
    const SurfacePoint expected = nearest_of_all(mesh, query_m);
    const auto found = index.nearest(query_m, expected.distance_m * (1.0 + 1e-12));
    ASSERT_TRUE(found) << i;
    ASSERT_EQ(found->distance_m, expected.distance_m) << i;
    ASSERT_EQ(found->triangle, expected.triangle) << i;
    const Vec3 direction = somewhere(random, 1.0);
    const auto hit = index.first_hit(query_m, direction);
    const double first_m = first_hit_of_all(mesh, query_m, direction);
    ASSERT_EQ(hit.has_value(), first_m < 1e9) << i;
    if (hit) {
      ++hits;
      ASSERT_NEAR(hit->distance_m, first_m, 1e-12) << i;
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(SurfaceIndex, AnswersFromBeyondSinglePrecision) {
  const SurfaceIndex index(vertebra_sized_box());
  const auto found = index.nearest({1e30, 0.0, 0.0}, 1e300);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->point_m.x, 0.04);
  const auto from_afar = index.nearest({1e160, 0.0, 0.0}, 1e300);
  EXPECT_FALSE(from_afar && !std::isfinite(from_afar->point_m.x));
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
    const double expected = first_hit_of_all(mesh, origin_m, direction);
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
  EXPECT_FALSE(index.nearest({std::nan(""), 0, 0}));
  EXPECT_FALSE(index.nearest({0, 0, 0}, std::nan("")));
  EXPECT_FALSE(index.first_hit({0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(index.first_hit({0, 0, 0}, {0, std::nan(""), 0}));
  EXPECT_FALSE(index.first_hit({0, std::nan(""), 0}, {1, 0, 0}));
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
