#include "nav/guidance/executed_trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace orthonav::nav::executed_trajectory_test {
namespace {

constexpr double kRounding = 1e-12;
const ScrewPlan kPlan{Side::kLeft, {{0.015, 0.020, 0.0}}, {{0.015, -0.020, 0.0}}, 0.003};

/// A tool `depth_m` deep along a line that enters `beside_m` from the plan and is tilted by
/// `lean_rad` towards +x.
Axis<Vertebra> tool(double depth_m, double beside_m = 0.0, double lean_rad = 0.0) {
  const Vec3 direction{std::sin(lean_rad), -std::cos(lean_rad), 0.0};
  const Vec3 entry = kPlan.entry.v + Vec3{beside_m, 0.0, 0.0};
  return {{entry + depth_m / std::cos(lean_rad) * direction}, direction};
}

PoseUncertainty uncertain(double translation_m, double rotation_rad) {
  std::array<double, 36> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[7 * i] = translation_m * translation_m;
    c[7 * (i + 3)] = rotation_rad * rotation_rad;
  }
  return {kPlan.entry.v, c};
}

TEST(TrajectoryAtDepth, IsWhereTheToolWasAtItsDeepest) {
  TrajectoryAtDepth at_depth;
  EXPECT_FALSE(at_depth.mean());
  for (const double depth_m : {0.0, 0.010, 0.020, 0.0300, 0.0302, 0.0301}) {
    // On the way in it was tilted differently.
    at_depth.add(kPlan, depth_m < 0.03 ? tool(depth_m, 0.004, 0.2) : tool(depth_m, 0.001, 0.02),
                 nullptr);
  }
  at_depth.add(kPlan, tool(0.012, -0.003, -0.1), nullptr);  // drawn back
  const auto mean = at_depth.mean();
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->pairs, 3u);
  EXPECT_NEAR(mean->depth_m, 0.0301, kRounding);
  EXPECT_LT((mean->axis.point.v - Vec3{0.016, 0.020, 0.0}).norm(), kRounding);
  EXPECT_LT((mean->axis.direction - tool(0.0, 0.0, 0.02).direction).norm(), kRounding);
  EXPECT_FALSE(mean->point_covariance_m2) << "nobody knows the pose's";
}

TEST(TrajectoryAtDepth, LeavesAToolThatRunsAcrossThePlanOut) {
  TrajectoryAtDepth at_depth;
  at_depth.add(kPlan, tool(0.03, 0.0, 1.1), nullptr);
  EXPECT_FALSE(at_depth.mean());
}

TEST(TrajectoryAtDepth, AveragesScatterButNotThePosesOwnError) {
  constexpr int kPairs = 400;
  constexpr double kScatter_m = 0.0002;
  constexpr double kScatter_rad = 0.003;
  Random random(11);
  TrajectoryAtDepth at_depth;
  const PoseUncertainty own = uncertain(0.0005, 0.004);
  for (int i = 0; i < kPairs; ++i) {
    at_depth.add(
        kPlan, tool(0.030, random.normal(0.0, kScatter_m), random.normal(0.0, kScatter_rad)), &own);
  }
  const auto mean = at_depth.mean();
  ASSERT_TRUE(mean && mean->point_covariance_m2 && mean->direction_covariance_rad2);
  EXPECT_EQ(mean->pairs, static_cast<std::size_t>(kPairs));
  // Along x the scatter of a mean of 400 is added; along z there is none.
  const double own_m2 = 0.0005 * 0.0005;
  const double left_m2 = kScatter_m * kScatter_m / kPairs;
  EXPECT_NEAR((*mean->point_covariance_m2)[0], own_m2 + left_m2, 0.2 * left_m2);
  EXPECT_NEAR((*mean->point_covariance_m2)[8], own_m2, 1e-3 * left_m2);
  const double own_rad2 = 0.004 * 0.004;
  const double left_rad2 = kScatter_rad * kScatter_rad / kPairs;
  EXPECT_NEAR((*mean->direction_covariance_rad2)[8], own_rad2 + left_rad2, 0.2 * left_rad2);
  EXPECT_NEAR((*mean->direction_covariance_rad2)[0], own_rad2, 1e-3 * left_rad2);
}

}  // namespace
}  // namespace orthonav::nav::executed_trajectory_test
