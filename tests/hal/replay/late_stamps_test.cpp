// StreamRecorder's late stamps, and the error that they cause at a pointer's tip while the head
// turns.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/angle.h"
#include "hal/replay/late_poses.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/depth_scene.h"
#include "tests/support/session_log.h"
#include "tests/support/stream_recorder_folder.h"

namespace orthonav::replay::late_stamps_test {
namespace {

using orthonav::test::play;
using orthonav::test::SessionLog;
using orthonav::test::StreamRecorderFolder;
using ::testing::HasSubstr;

constexpr std::int64_t kFrame = 333'333;  // ticks of 100 ns at 30 Hz
constexpr std::int64_t kLate = 125'000;
constexpr double kRotation_rad_s = 30.0 / kDegreesPerRadian;
constexpr Point<Rig> kTipInRig{{0.0, 0.0, -0.45}};
/// 12.5 ms at 30 degrees a second are 6.5 mrad.
constexpr double kLateTipM = 0.00294;
/// Nine digits of the poses in the files, and a line between two of them.
constexpr double kNineDigitsM = 1e-6;

/// So many ticks after the recording's start.
Transform<World, Rig> head_at(std::int64_t ticks) {
  return {rotation_from_vector({0.0, kRotation_rad_s * 1e-7 * static_cast<double>(ticks), 0.0}),
          {0.0, 1.6, 0.0}};
}

std::string pose_line(std::int64_t ticks) {
  std::string line = std::to_string(StreamRecorderFolder::kStart + ticks);
  for (const double entry : head_at(ticks).row_major()) {
    char number[32];
    std::snprintf(number, sizeof(number), ",%.9g", entry);
    line += number;
  }
  return line + "\n";
}

/// A head that turns by 30 degrees a second; each image was taken 12.5 ms before its stamp.
class RotatingRecording {
 public:
  RotatingRecording() {
    std::string poses;
    for (int n = 0; n < 5; ++n) {
      poses += pose_line(kFrame * n);
    }
    folder_.write("VLC LF_rig2world.txt", poses);
  }
  /// The largest error of a tip seen in an image, and the least.
  [[nodiscard]] std::pair<double, double> tip_errors_m(RecordedStamps stamps) const {
    ReplayOptions options;
    options.stamps = stamps;
    const auto headset = ReplayHeadset::open(folder_.path(), options);
    EXPECT_TRUE(headset.ok()) << headset.error().message;
    const SessionLog log = play(**headset);
    EXPECT_EQ(log.moments.size(), 5u);
    std::pair<double, double> errors{0.0, 1.0};
    for (std::size_t n = 0; n < log.moments.size(); ++n) {
      const StereoFrame& frame = log.moments[n].frame;
      const auto stamp = kFrame * static_cast<std::int64_t>(n);
      EXPECT_EQ((*headset)->file_ticks_100ns(frame.time), StreamRecorderFolder::kStart + stamp)
          << "as the image is called";
      const Point<World> tip = *frame.world_from_rig * kTipInRig;
      const double off_m = (tip.v - (head_at(stamp - kLate) * kTipInRig).v).norm();
      errors = {std::max(errors.first, off_m), std::min(errors.second, off_m)};
      EXPECT_EQ(log.moments[n].head_now.status, PoseStatus::kMeasured);
    }
    return errors;
  }
  [[nodiscard]] const StreamRecorderFolder& folder() const { return folder_; }

 private:
  StreamRecorderFolder folder_{{0, kFrame, 2 * kFrame, 3 * kFrame, 4 * kFrame},
                               {0, kFrame, 2 * kFrame, 3 * kFrame, 4 * kFrame}};
};

TEST(LateStamps, AreCorrectedInStreamRecordersFiles) {
  const RotatingRecording recording;
  EXPECT_LT(recording.tip_errors_m(RecordedStamps::kByRecorder).first, kNineDigitsM);
}

/// The control that must fail: as recorded, the tip is 3 mm off.
TEST(LateStamps, CostThreeMillimetresWhereTheyAreTakenAsExact) {
  const RotatingRecording recording;
  const auto [most_m, least_m] = recording.tip_errors_m(RecordedStamps::kExact);
  EXPECT_NEAR(most_m, kLateTipM, 0.00002);
  EXPECT_NEAR(least_m, kLateTipM, 0.00002);
}

TEST(LateStamps, AreWhatTheFolderSays) {
  const RotatingRecording recording;
  recording.folder().write("device.csv", "key,value\nstamps_late_ns,0\n");
  EXPECT_NEAR(recording.tip_errors_m(RecordedStamps::kByRecorder).first, kLateTipM, 0.00002);
  recording.folder().write("device.csv", "key,value\nstamps_late_ns,12500000\n");
  EXPECT_LT(recording.tip_errors_m(RecordedStamps::kByRecorder).first, kNineDigitsM);
  recording.folder().write("device.csv", "key,value\nstamps_late_ns,100000001\n");
  const auto refused = ReplayHeadset::open(recording.folder().path());
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("stamps_late_ns must lie in [0, 100000000]"));
}

/// Depth cameras are not late: a picture stamped with a pair was taken 12.5 ms after it.
TEST(LateStamps, AreTheFrontCamerasAlone) {
  const RotatingRecording recording;
  orthonav::test::DepthScene scene;
  scene.pictures = orthonav::test::DepthScene::located({kFrame});
  scene.write_stream_recorder(recording.folder().path(), "Depth AHaT");
  for (const bool exact : {false, true}) {
    ReplayOptions options;
    options.stamps = exact ? RecordedStamps::kExact : RecordedStamps::kByRecorder;
    const auto headset = ReplayHeadset::open(recording.folder().path(), options);
    ASSERT_TRUE(headset.ok()) << headset.error().message;
    StereoFrame pair;
    ASSERT_TRUE((*headset)->cameras()->next(pair).ok());
    const Timestamp first = pair.time;
    while (*(*headset)->cameras()->next(pair) == Next::kFrame) {
    }
    DepthFrame depth;
    ASSERT_EQ((*headset)->depth_cameras().size(), 1u);
    ASSERT_EQ(*(*headset)->depth_cameras().front()->next(depth), Next::kFrame);
    EXPECT_EQ(depth.time - first,
              Duration(100) * kFrame + (exact ? Duration::zero() : kResearchModeStampsLate));
  }
}

TEST(LatePoses, KeepWhatStandsAndLeaveOutWhatStandsAlone) {
  PosesByTicks at_stamps;
  const Transform<World, Rig> still{Mat3::identity(), {1.0, 2.0, 3.0}};
  at_stamps.emplace(0, still);
  at_stamps.emplace(kFrame, still);
  at_stamps.emplace(30 * kFrame, still);
  const PosesByTicks taken = poses_at_exposure(at_stamps, Duration(12'500'000));
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken.at(0), still);
  EXPECT_EQ(taken.at(kFrame), still);
}

/// Where World jumps, the pose after it is computed from those of its own world.
TEST(LatePoses, NeverMixTwoWorlds) {
  const Transform<World, World> jump(Mat3::identity(), {0.5, 0.0, 0.0});
  PosesByTicks at_stamps;
  for (int n = 0; n < 4; ++n) {
    at_stamps.emplace(kFrame * n, n < 2 ? head_at(kFrame * n) : jump * head_at(kFrame * n));
  }
  const PosesByTicks taken = poses_at_exposure(at_stamps, Duration(12'500'000));
  ASSERT_EQ(taken.size(), 4u);
  const auto expected = jump * head_at(2 * kFrame - kLate);
  EXPECT_LT((taken.at(2 * kFrame).translation() - expected.translation()).norm(), 1e-9);
  EXPECT_LT(rotation_angle_rad(taken.at(2 * kFrame).rotation(), expected.rotation()), 1e-9);
}

}  // namespace
}  // namespace orthonav::replay::late_stamps_test
