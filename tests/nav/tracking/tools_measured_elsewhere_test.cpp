#include "nav/tracking/tools_measured_elsewhere.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nav/tracking/anchored_tracker.h"

namespace orthonav::nav::tools_measured_elsewhere_test {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kMeasured = {"reference", "pointer"};

std::vector<ToolGeometry> three_tools() {
  std::vector<ToolGeometry> tools = {{"pointer", ToolRole::kPointer},
                                     {"guide", ToolRole::kGuide},
                                     {"reference", ToolRole::kReference}};
  for (ToolGeometry& tool : tools) {
    tool.marker = {"", 0, 0.0};
  }
  return tools;
}

TrackedPose measured(Vec3 at_m, double variance_m2) {
  TrackedPose out{{Mat3::identity(), at_m}, {}, PoseStatus::kMeasured, {}};
  out.covariance[0] = variance_m2;
  return out;
}

const TrackedPose kLost;

ToolPoses poses_at(int ms, const TrackedPose& reference, const TrackedPose& pointer) {
  ToolPoses poses;
  poses.time = Timestamp(std::chrono::milliseconds(ms));
  poses.tools = {reference, pointer};
  for (TrackedPose& tool : poses.tools) {
    tool.time = poses.time;
  }
  return poses;
}

TEST(ToolsMeasuredElsewhere, AreHandedOnAsTheyCameWithTheCovarianceStated) {
  const auto tracker = create_tracker_of_poses(kMeasured, three_tools()).value();
  const auto states = tracker->take(poses_at(10, kLost, measured({0.1, 0.0, 1.0}, 4e-8)));
  ASSERT_EQ(states.size(), 3u);
  const TrackedPose& pointer = states[0].world_from_marker;
  EXPECT_EQ(pointer.status, PoseStatus::kMeasured);
  EXPECT_EQ(pointer.time, Timestamp(std::chrono::milliseconds(10)));
  EXPECT_EQ(pointer.value.translation(), (Vec3{0.1, 0.0, 1.0}));
  EXPECT_EQ(pointer.covariance[0], 4e-8);
  ASSERT_TRUE(states[0].pair);
  EXPECT_EQ(states[0].pair->covariance[0], 4e-8);
  EXPECT_EQ(states[1].world_from_marker.status, PoseStatus::kLost) << "nobody measures it";
  EXPECT_EQ(states[2].world_from_marker.status, PoseStatus::kLost) << "out of sight";
}

TEST(ToolsMeasuredElsewhere, AreLostAtOnceAndNeverPredicted) {
  const auto tracker = create_tracker_of_poses(kMeasured, three_tools()).value();
  tracker->take(poses_at(0, kLost, measured({0.1, 0.0, 0.0}, 1e-8)));
  tracker->take(poses_at(10, kLost, measured({0.2, 0.0, 0.0}, 1e-8)));
  const auto states = tracker->take(poses_at(20, kLost, kLost));
  EXPECT_EQ(states[0].world_from_marker.status, PoseStatus::kLost);
  EXPECT_FALSE(states[0].pair);
}

TEST(ToolsMeasuredElsewhere, AreNeitherFilteredNorPredictedAgainstAReference) {
  auto tracker = create_anchored_tracker(create_tracker_of_poses(kMeasured, three_tools()).value(),
                                         std::chrono::milliseconds(100))
                     .value();
  const Vec3 reference{0.3, 0.2, 0.1};
  // Half a millimetre to and fro: a filter would not follow it.
  for (int i = 0; i < 20; ++i) {
    const Vec3 pointer{i % 2 == 0 ? 0.1 : 0.1005, 0.0, 0.0};
    const auto states =
        tracker->take(poses_at(10 * i, measured(reference, 1e-8), measured(pointer, 1e-6)));
    const Vec3 relative = states[0].world_from_marker.value.translation() -
                          states[2].world_from_marker.value.translation();
    EXPECT_NEAR(relative.norm(), (pointer - reference).norm(), 1e-9) << i;
  }
  const auto states = tracker->take(poses_at(200, measured(reference, 1e-8), kLost));
  EXPECT_EQ(states[0].world_from_marker.status, PoseStatus::kLost);
}

TEST(ToolsMeasuredElsewhere, OfANameThatNoToolHasAreRefused) {
  const auto tracker =
      create_tracker_of_poses(std::vector<std::string>{"pointer", "probe"}, three_tools());
  ASSERT_FALSE(tracker.ok());
  EXPECT_THAT(tracker.error().message, HasSubstr("measures \"probe\""));
  EXPECT_THAT(tracker.error().message, HasSubstr("pointer; guide; reference"));
}

TEST(ToolsMeasuredElsewhere, NeedNoTagsAndCamerasDo) {
  EXPECT_TRUE(problems_of(three_tools()).empty());
  const Status seen = check({}, three_tools(), {});
  ASSERT_FALSE(seen.ok());
  EXPECT_THAT(seen.error().message, HasSubstr("tool 'pointer' has no tag"));
}

}  // namespace
}  // namespace orthonav::nav::tools_measured_elsewhere_test
