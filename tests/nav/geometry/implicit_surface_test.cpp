#include "nav/geometry/implicit_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/test_meshes.h"

namespace orthonav::nav::implicit_surface_test {
namespace {

TEST(ImplicitSurface, MeshesABallToItsRadius) {
  constexpr double kRadius_m = 0.020;
  constexpr double kOnTheSurface_m = 1e-7;  // three Newton steps from a grid of 1.4 mm
  const TriangleMesh ball = surface_of([](Vec3 p) { return p.norm() - kRadius_m; },
                                       {-0.03, -0.03, -0.03}, {0.03, 0.03, 0.03}, 0.0014);
  ASSERT_GT(ball.vertices_m.size(), 1000u);
  for (const Vec3& v : ball.vertices_m) {
    EXPECT_NEAR(v.norm(), kRadius_m, kOnTheSurface_m);
  }
  EXPECT_EQ(ball.vertices_m.size() * 2, ball.triangles.size() + 4) << "a sphere: genus 0";
  const double ball_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius_m, 3);
  EXPECT_NEAR(engine::volume_m3(ball) / ball_m3, 1.0, 0.005) << "flat facets cut off a little";
  EXPECT_LT(engine::volume_m3(ball), ball_m3);
}

}  // namespace
}  // namespace orthonav::nav::implicit_surface_test
