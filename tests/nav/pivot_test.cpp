#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hal/api/random.h"
#include "nav/tracking/pivot.h"

namespace orthonav::nav {
namespace {

using ::testing::HasSubstr;
using Pose = Transform<World, Marker>;

const Vec3 kTip{0.003, -0.15, 0.002};
const Vec3 kPivot{0.4, 1.1, -0.6};

// Turned about the pivot in a cone of the given half angle, with noise of position and rotation.
std::vector<Pose> pivoting(double cone_rad, double twist_rad, double noise_m, Random& random,
                           int count = 200) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double around = 0.37 * i;
    const Mat3 rotation = rotation_from_vector(
        {cone_rad * std::cos(around), twist_rad * std::sin(0.11 * i), cone_rad * std::sin(around)});
    const Vec3 noise{random.normal(0, noise_m), random.normal(0, noise_m),
                     random.normal(0, noise_m)};
    poses.emplace_back(rotation, kPivot - rotation * kTip + noise);
  }
  return poses;
}

TEST(PivotCalibration, FindsTipAndPivotExactly) {
  Random random(1);
  const auto found = pivot_calibration(pivoting(0.5, 0.3, 0.0, random));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_LT((found->tip_in_marker.v - kTip).norm(), 1e-12);
  EXPECT_LT((found->pivot_in_world.v - kPivot).norm(), 1e-12);
  EXPECT_LT(found->rmse_m, 1e-12);
  EXPECT_GT(found->spread_rad, 0.3);
}

TEST(PivotCalibration, PredictsItsOwnError) {
  double squared = 0.0;
  double predicted = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<std::uint64_t>(trial));
    const auto found = pivot_calibration(pivoting(0.4, 0.2, 0.0005, random));
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_NEAR(found->rmse_m, 0.0005 * std::sqrt(3.0), 0.0001);
    squared += (found->tip_in_marker.v - kTip).squared_norm();
    predicted += found->tip_sigma_m * found->tip_sigma_m;
  }
  // 100 draws of three numbers: the ratio of variances lies within 25 % (3 SD).
  EXPECT_NEAR(squared / predicted, 1.0, 0.25);
}

TEST(PivotCalibration, RefusesTooLittleTurning) {
  Random random(2);
  EXPECT_THAT(pivot_calibration(pivoting(0.1, 0.0, 0.0, random)).error().message,
              HasSubstr("turned by"));
  // Twisting about one axis leaves the tip free along it, however far it turns.
  EXPECT_FALSE(pivot_calibration(pivoting(0.0, 1.5, 0.0, random)).ok());
  EXPECT_TRUE(pivot_calibration(pivoting(0.25, 0.0, 0.0, random)).ok());
}

TEST(PivotCalibration, RefusesATipThatSlipped) {
  Random random(3);
  auto poses = pivoting(0.4, 0.2, 0.0002, random);
  for (std::size_t i = poses.size() / 2; i < poses.size(); ++i)
    poses[i] = {poses[i].rotation(), poses[i].translation() + Vec3{0.006, 0, 0}};
  EXPECT_THAT(pivot_calibration(poses).error().message, HasSubstr("slip"));
}

TEST(PivotCalibration, RefusesTooFewAndNonFinitePoses) {
  Random random(4);
  EXPECT_THAT(pivot_calibration(pivoting(0.4, 0.2, 0.0, random, 19)).error().message,
              HasSubstr("19 poses, at least 20"));
  EXPECT_FALSE(pivot_calibration({}).ok());
  auto poses = pivoting(0.4, 0.2, 0.0, random);
  poses[5] = {poses[5].rotation(), {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  EXPECT_THAT(pivot_calibration(poses).error().message, HasSubstr("not finite"));
}

}  // namespace
}  // namespace orthonav::nav
