// The promises of every depth camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/contract/device_cases.h"
#include "tests/support/session_log.h"

namespace orthonav {
namespace {

using orthonav::test::DeviceCase;
using orthonav::test::play;
using orthonav::test::SessionLog;

class DepthContract : public ::testing::TestWithParam<DeviceCase> {
 protected:
  void SetUp() override { ASSERT_NE(headset_, nullptr); }
  std::unique_ptr<Headset> headset_ = GetParam().open();
};

TEST_P(DepthContract, HasItsCamerasAtEveryCall) {
  const auto cameras = headset_->depth_cameras();
  EXPECT_EQ(cameras.size(), GetParam().depth_cameras);
  EXPECT_EQ(headset_->depth_cameras(), cameras);
  for (const DepthCamera* camera : cameras) {
    EXPECT_NE(camera, nullptr);
  }
}

TEST_P(DepthContract, DescribesEachPixelByAUnitRayOrNone) {
  for (const DepthCamera* camera : headset_->depth_cameras()) {
    const DepthCalibration& calibration = camera->calibration();
    const auto pixels = static_cast<std::size_t>(calibration.width_px) *
                        static_cast<std::size_t>(calibration.height_px);
    ASSERT_EQ(calibration.rays.size(), pixels);
    std::size_t seeing = 0;
    for (const auto& [x, y, z] : calibration.rays) {
      if (z == 0.0F) {
        continue;
      }
      EXPECT_GT(z, 0.0F);
      EXPECT_NEAR(std::hypot(x, y, z), 1.0, 1e-6);
      ++seeing;
    }
    EXPECT_GT(seeing, pixels / 2);
  }
}

TEST_P(DepthContract, DeliversFramesInOrderOfTheCalibrationsSizeAndNoneFromTheFuture) {
  const auto cameras = headset_->depth_cameras();
  const SessionLog log = play(*headset_);
  EXPECT_TRUE(log.errors.empty());
  std::vector<const DepthFrame*> last(cameras.size());
  std::vector<int> frames(cameras.size());
  for (const auto& moment : log.depth) {
    const DepthCalibration& calibration = cameras[moment.camera]->calibration();
    const DepthFrame& frame = moment.frame;
    EXPECT_EQ(frame.range_mm.width_px, calibration.width_px);
    EXPECT_EQ(frame.range_mm.height_px, calibration.height_px);
    EXPECT_EQ(frame.range_mm.pixels.size(), calibration.rays.size());
    if (!frame.brightness.pixels.empty()) {
      EXPECT_EQ(frame.brightness.pixels.size(), calibration.rays.size());
    }
    EXPECT_LE(frame.time, moment.clock) << "a picture out of the future";
    if (const DepthFrame* before = last[moment.camera]) {
      EXPECT_GT(frame.time, before->time);
      EXPECT_GT(frame.sequence, before->sequence);
      EXPECT_GE(frame.map_epoch, before->map_epoch);
    }
    last[moment.camera] = &frame;
    ++frames[moment.camera];
  }
  for (const int count : frames) {
    EXPECT_GE(count, 2);
  }
}

TEST_P(DepthContract, NeverGivesAnAhatRangeThatIsNoMeasurement) {
  constexpr std::uint16_t kMark = 4090;
  const auto cameras = headset_->depth_cameras();
  for (const auto& moment : play(*headset_).depth) {
    if (cameras[moment.camera]->calibration().stream != DepthStream::kAhat) {
      continue;
    }
    for (const std::uint16_t range_mm : moment.frame.range_mm.pixels) {
      ASSERT_LT(range_mm, kMark);
    }
  }
}

TEST_P(DepthContract, DoesNotHoldUpPairsWhereNobodyAsksForIt) {
  StereoFrame frame;
  constexpr int kMaxCalls = 2000;
  for (int call = 0; call < kMaxCalls; ++call) {
    const auto answer = headset_->cameras()->next(frame);
    ASSERT_TRUE(answer.ok());
    if (*answer == Next::kEnd) {
      return;
    }
  }
  ADD_FAILURE() << "the pairs never end";
}

/// Those that have depth, and one that has none.
std::vector<DeviceCase> cases() {
  std::vector<DeviceCase> all = orthonav::test::device_cases();
  std::erase_if(all, [](const DeviceCase& device) { return device.measures_tools; });
  const auto flat = std::stable_partition(
      all.begin(), all.end(), [](const DeviceCase& device) { return device.depth_cameras > 0; });
  all.erase(flat == all.end() ? flat : flat + 1, all.end());
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, DepthContract, ::testing::ValuesIn(cases()),
                         [](const auto& device) { return device.param.name; });

}  // namespace
}  // namespace orthonav
