#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"
#include "nav/calibration/spin.h"

namespace orthonav::nav::spin_test {
namespace {

using ::testing::HasSubstr;
using Pose = Transform<World, Marker>;

const Direction<Marker> kGiven{{0, 1, 0}};
const Vec3 kAxis = Vec3{0.02, 1.0, -0.015}.normalized();  // 1.4° from the given one
const Point<Marker> kTip{{0.001, -0.15, 0.002}};

/// Turned evenly to and fro about its axis by `range_rad` in all, with noise.
std::vector<Pose> spinning(double range_rad, double noise_rad, Random& random, int count = 200) {
  const Mat3 first = rotation_from_vector({0.3, 0.2, -0.5});
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = range_rad * (std::abs(std::fmod(0.037 * i, 2.0) - 1.0) - 0.5);
    const Vec3 noise{random.normal(0, noise_rad), random.normal(0, noise_rad),
                     random.normal(0, noise_rad)};
    const Mat3 rotation =
        rotation_from_vector(noise) * first * rotation_from_vector(angle_rad * kAxis);
    poses.emplace_back(rotation, Vec3{0.4, 1.1, -0.6} - rotation * kTip.v);
  }
  return poses;
}

Result<SpinCalibration> calibrated(const std::vector<Pose>& poses) {
  return spin_calibration(poses, kTip, kGiven);
}

TEST(SpinCalibration, FindsTheAxisExactly) {
  Random random(1);
  const auto found = calibrated(spinning(2.0, 0.0, random));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_LT(angle_between_rad(found->axis_in_marker.v, kAxis), 1e-7);
  EXPECT_NEAR(found->off_rad, angle_between_rad(kAxis, kGiven.v), 1e-7);
  EXPECT_LT(found->tip_beside_m.norm(), 1e-9);
  EXPECT_EQ(found->judgement.verdict, Verdict::kPass) << found->judgement.reason;
}

TEST(SpinCalibration, PredictsItsOwnError) {
  double squared = 0.0;
  double predicted = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<std::uint64_t>(trial));
    const auto found = calibrated(spinning(1.8, 0.004, random));
    ASSERT_TRUE(found.ok()) << found.error().message;
    const double off = angle_between_rad(found->axis_in_marker.v, kAxis);
    squared += off * off;
    predicted += found->axis_sigma_rad * found->axis_sigma_rad;
  }
  // As for the tip, the larger of two estimates is reported, which is above the truth on average.
  EXPECT_NEAR(squared / predicted, 0.85, 0.3);
}

TEST(SpinCalibration, TellsHowFarTheTipLiesBesideTheAxis) {
  Random random(2);
  const auto poses = spinning(2.0, 0.0, random);
  const Vec3 across = kAxis.cross({0, 0, 1}).normalized();
  const auto found =
      spin_calibration(poses, Point<Marker>{kTip.v + 0.002 * across + 0.01 * kAxis}, kGiven);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_LT((found->tip_beside_m - 0.002 * across).norm(), 1e-9);
  EXPECT_THAT(found->judgement.reason, HasSubstr("2.00 mm beside that axis"));
}

TEST(SpinCalibration, LeavesOutWhatCameBeforeAndAfterTheSpin) {
  Random random(3);
  auto poses = spinning(1.8, 0.002, random);
  const double alone = angle_between_rad(calibrated(poses)->axis_in_marker.v, kAxis);
  for (std::size_t i = 0; i < poses.size() / 4; ++i) {
    const Mat3 tilted = rotation_from_vector({0.01 * static_cast<double>(i), 0, 0.2});
    poses[i] = Pose(tilted * poses[i].rotation(), poses[i].translation());
  }
  const auto found = calibrated(poses);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(static_cast<double>(found->inliers), 150.0, 6.0);
  EXPECT_LT(angle_between_rad(found->axis_in_marker.v, kAxis), alone + 0.002);
}

TEST(SpinCalibration, RefusesInOneLineWithTheLimit) {
  Random random(4);
  EXPECT_THAT(calibrated(spinning(0.5, 0.0005, random)).error().message,
              HasSubstr("the tool turned by"));
  EXPECT_THAT(calibrated(spinning(1.8, 0.03, random)).error().message,
              HasSubstr("54 % of the poses agree on an axis, at least 60 %"));
  EXPECT_THAT(calibrated(spinning(1.8, 0.0, random, 10)).error().message,
              HasSubstr("10 poses, at least 20"));
  const auto other = spin_calibration(spinning(1.8, 0.0, random), kTip, {{1, 0, 0}});
  EXPECT_THAT(other.error().message, HasSubstr("from its own, limit"));
  auto broken = spinning(1.8, 0.0, random);
  broken[7] = Pose(broken[7].rotation(), {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  EXPECT_THAT(calibrated(broken).error().message, HasSubstr("not finite"));
}

TEST(SpinCalibration, GivesTheSameBitsAgain) {
  Random random(5);
  const auto poses = spinning(1.8, 0.004, random);
  EXPECT_EQ(calibrated(poses)->axis_in_marker, calibrated(poses)->axis_in_marker);
}

}  // namespace
}  // namespace orthonav::nav::spin_test
