#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "nav/geometry/principal_axes.h"
#include "nav/geometry/triangle.h"
#include "nav/registration/vertebra_model.h"
#include "tests/support/mesh_builder.h"
#include "tests/support/registration_builder.h"

namespace orthonav::nav {
namespace {

/// A "vertebra" of boxes: a body in front, a ring behind it round a canal, a spine at the back.
/// Seen along z it is a square tube (the canal) with walls of 5 mm, 30 mm across.
TriangleMesh tube() {
  TriangleMesh mesh;
  const double outer = 0.015;
  const double inner = 0.010;
  for (const double z : {-0.015, 0.015}) {
    for (const double r : {outer, inner}) {
      for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        mesh.vertices_m.push_back({r * x, r * y, z});
      }
    }
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t n = (k + 1) % 4;
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    };
    quad(k, n, 8 + n, 8 + k);            // outside
    quad(4 + n, 4 + k, 12 + k, 12 + n);  // inside of the tube
    quad(n, k, 4 + k, 4 + n);            // bottom rim
    quad(8 + k, 8 + n, 12 + n, 12 + k);  // top rim
  }
  return mesh;
}

TEST(Trimming, KeepsTheBackAndDropsCanalAndFront) {
  const auto mesh = checked_bone(tube());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const SurfaceIndex surface(*mesh);
  const TriangleMesh kept = part_of(*mesh, faces_reachable_from_behind(*mesh, surface));
  ASSERT_FALSE(kept.triangles.empty());
  bool back = false;
  for (const auto& t : kept.triangles) {
    const Triangle corners{kept.vertices_m[t[0]], kept.vertices_m[t[1]], kept.vertices_m[t[2]]};
    const Vec3 normal = triangle_normal(corners);
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    EXPECT_GT(normal.y, -0.9) << "a face that looks forward";
    const bool on_canal_front = normal.y > 0.9 && centre.y < 0.0;
    EXPECT_FALSE(on_canal_front) << "the front wall of the canal";
    back = back || (normal.y > 0.9 && centre.y > 0.014);
  }
  EXPECT_TRUE(back);
}

TEST(Trimming, LeavesTheBodyOutOfEveryRealVertebraAndKeepsWhatIsStroked) {
  const auto levels = test::anatomy_levels();
  if (levels.empty()) {
    GTEST_SKIP() << "needs shared/anatomy";
  }
  for (const auto& level : levels) {
    const auto model = VertebraModel::prepare(level.mesh);
    ASSERT_TRUE(model.ok()) << level.name << ": " << model.error().message;
    const auto& reachable = (*model)->reachable();
    // The origin is the body's centroid; its back wall lies at least 10 mm behind it.
    for (const Vec3& v : reachable.vertices_m) {
      ASSERT_GT(v.y, 0.010) << level.name;
    }
    EXPECT_LT(reachable.triangles.size(), level.mesh.triangles.size() * 6 / 10) << level.name;
    Random random(11);
    std::size_t off = 0;
    const auto tips = test::strokes(level, {}, random);
    ASSERT_GT(tips.size(), 400U) << level.name;
    for (const Vec3& tip : tips) {
      if ((*model)->reachable_surface().nearest(tip)->distance_m > 1e-4) {
        ++off;
      }
    }
    EXPECT_EQ(off, 0U) << level.name;
  }
}

TEST(Trimming, RefusesAModelThatCannotBePrepared) {
  EXPECT_FALSE(VertebraModel::prepare({}).ok());
  EXPECT_FALSE(VertebraModel::prepare(test::box({0, 0, 0}, {80, 80, 80})).ok());
}

TEST(PrincipalAxes, AreRightHandedAndSortedBySpread) {
  Random random(4);
  const Mat3 rotation = test::random_rotation(random);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i) {
    points.push_back(
        rotation * Vec3{random.normal(0, 0.03), random.normal(0, 0.02), random.normal(0, 0.01)} +
        Vec3{1, 2, 3});
  }
  const PrincipalAxes axes = principal_axes(points);
  EXPECT_NEAR(Mat3::from_columns(axes.axes[0], axes.axes[1], axes.axes[2]).determinant(), 1.0,
              1e-12);
  EXPECT_LT((axes.centre_m - Vec3{1, 2, 3}).norm(), 0.001);
  const std::array<double, 3> spread = {0.03, 0.02, 0.01};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(axes.deviation_m[k], spread[k], 0.02 * spread[k]);  // 4 sigma of 20000 draws
    EXPECT_GT(std::abs(axes.axes[k].dot(rotation.column(k))), 0.999);
  }
}

TEST(PrincipalAxes, WeighPointsAsTold) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<double> weights = {1.0, 1.0, 2.0};
  EXPECT_LT((principal_axes(points, weights).centre_m - Vec3{0.25, 0.5, 0}).norm(), 1e-15);
}

}  // namespace
}  // namespace orthonav::nav
