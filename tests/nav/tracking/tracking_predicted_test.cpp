#include <gtest/gtest.h>

#include "nav/tracking/tool_tracker.h"

namespace orthonav::nav {
namespace {

constexpr Duration kCoast = std::chrono::milliseconds(100);

Timestamp at_ms(int ms) { return Timestamp(std::chrono::milliseconds(ms)); }

TrackedPose measured(int ms, Vec3 position, Vec3 rotation_rad) {
  TrackedPose pose;
  pose.value = {rotation_from_vector(rotation_rad), position};
  pose.time = at_ms(ms);
  pose.status = PoseStatus::kMeasured;
  for (std::size_t i = 0; i < 6; ++i) {
    pose.covariance[7 * i] = i < 3 ? 1e-8 : 1e-4;
  }
  return pose;
}

const TrackedPose kOlder = measured(1000, {0.1, 0.2, 0.3}, {0, 0, 0.1});
const TrackedPose kNewer = measured(1040, {0.12, 0.2, 0.29}, {0, 0, 0.14});

TEST(PredictedPose, MovesOnWithConstantVelocity) {
  const TrackedPose pose = predicted(kOlder, kNewer, at_ms(1060), kCoast);
  EXPECT_EQ(pose.status, PoseStatus::kPredicted);
  EXPECT_EQ(pose.time, at_ms(1060));
  EXPECT_LT((pose.value.translation() - Vec3{0.13, 0.2, 0.285}).norm(), 1e-12);
  EXPECT_LT(rotation_angle_rad(pose.value.rotation(), rotation_from_vector({0, 0, 0.16})), 1e-9);
}

TEST(PredictedPose, GrowsLessSure) {
  double last = kNewer.covariance[0];
  for (const int ms : {1041, 1060, 1100, 1140}) {
    const TrackedPose pose = predicted(kOlder, kNewer, at_ms(ms), kCoast);
    EXPECT_GT(pose.covariance[0], last) << ms;
    EXPECT_GT(pose.covariance[35], kNewer.covariance[35]) << ms;
    last = pose.covariance[0];
  }
  // A hand may stray by millimetres in 100 ms, not by decimetres.
  EXPECT_GT(std::sqrt(last), 0.001);
  EXPECT_LT(std::sqrt(last), 0.03);
}

TEST(PredictedPose, IsTheMeasurementAtItsOwnTime) {
  const TrackedPose pose = predicted(kOlder, kNewer, at_ms(1040), kCoast);
  EXPECT_EQ(pose.status, PoseStatus::kMeasured);
  EXPECT_EQ(pose.value, kNewer.value);
}

TEST(PredictedPose, LiesBetweenTheTwoInBetween) {
  const TrackedPose pose = predicted(kOlder, kNewer, at_ms(1020), kCoast);
  EXPECT_EQ(pose.status, PoseStatus::kPredicted);
  EXPECT_LT((pose.value.translation() - Vec3{0.11, 0.2, 0.295}).norm(), 1e-12);
}

TEST(PredictedPose, IsLostPastTheCoast) {
  EXPECT_EQ(predicted(kOlder, kNewer, at_ms(1140), kCoast).status, PoseStatus::kPredicted);
  EXPECT_EQ(predicted(kOlder, kNewer, at_ms(1141), kCoast).status, PoseStatus::kLost);
  EXPECT_EQ(predicted(kOlder, kNewer, at_ms(999), kCoast).status, PoseStatus::kLost);
}

TEST(PredictedPose, IsLostWithoutAMeasurement) {
  EXPECT_EQ(predicted({}, {}, at_ms(10), kCoast).status, PoseStatus::kLost);
  TrackedPose guess = kNewer;
  guess.status = PoseStatus::kPredicted;
  EXPECT_EQ(predicted(kOlder, guess, at_ms(1050), kCoast).status, PoseStatus::kLost);
}

TEST(PredictedPose, StandsStillWithMoreDoubtWhenTheVelocityIsUnknown) {
  const TrackedPose along = predicted(kOlder, kNewer, at_ms(1060), kCoast);
  const TrackedPose old = measured(500, {0.9, 0.9, 0.9}, {});
  for (const TrackedPose& older : {TrackedPose{}, old}) {
    const TrackedPose pose = predicted(older, kNewer, at_ms(1060), kCoast);
    EXPECT_EQ(pose.status, PoseStatus::kPredicted);
    EXPECT_EQ(pose.value, kNewer.value);
    EXPECT_GT(pose.covariance[0], along.covariance[0]);
  }
}

}  // namespace
}  // namespace orthonav::nav
