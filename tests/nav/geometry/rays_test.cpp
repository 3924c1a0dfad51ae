#include <gtest/gtest.h>

#include <limits>

#include "base/random.h"
#include "nav/geometry/rays.h"

namespace orthonav::nav::rays_test {
namespace {

constexpr double kExactM = 1e-12;

TEST(ClosestPoint, FindsWhereRaysMeet) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 target{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                      random.uniform(0.2, 2.0)};
    const Vec3 left{};
    const Vec3 right{0.1, 0.01, 0.0};
    const auto met = closest_point({left, 3.0 * (target - left)}, {right, 0.2 * (target - right)});
    ASSERT_TRUE(met);
    EXPECT_LT((met->point_m - target).norm(), 1e-10);  // metres at 2 m over a base of 0.1 m
    EXPECT_LT(met->gap_m, 1e-12);
  }
}

TEST(ClosestPoint, TakesTheMiddleOfTheGap) {
  const auto met = closest_point({{-1, 0, 0}, {1, 0, 0}}, {{0, -1, 0.02}, {0, 7, 0}});
  ASSERT_TRUE(met);
  EXPECT_LT((met->point_m - Vec3{0, 0, 0.01}).norm(), kExactM);
  EXPECT_NEAR(met->gap_m, 0.02, kExactM);
}

TEST(ClosestPoint, RefusesWhatHasNoMeeting) {
  const Ray forward{{0, 0, 0}, {0, 0, 1}};
  EXPECT_FALSE(closest_point(forward, {{0.1, 0, 0}, {0, 0, 2}})) << "parallel";
  EXPECT_FALSE(closest_point(forward, {{0.1, 0, 0}, {1e-7, 0, 1}})) << "nearly parallel";
  EXPECT_TRUE(closest_point(forward, {{0.1, 0, 0}, {-1e-5, 0, 1}})) << "just not parallel";
  EXPECT_FALSE(closest_point(forward, {{0.1, 0, 0}, {0.1, 0, 1}})) << "behind both";
  EXPECT_FALSE(closest_point(forward, {{0.1, 0, 1}, {0.1, 0, 0}})) << "behind the second";
  EXPECT_FALSE(closest_point(forward, {{0.1, 0, 0}, {0, 0, 0}})) << "no direction";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(closest_point(forward, {{nan, 0, 0}, {-0.1, 0, 1}}));
  EXPECT_FALSE(closest_point({{0, 0, 0}, {nan, 0, 1}}, {{0.1, 0, 0}, {-0.1, 0, 1}}));
}

}  // namespace
}  // namespace orthonav::nav::rays_test
