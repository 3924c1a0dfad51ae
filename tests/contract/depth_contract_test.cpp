// What every depth camera promises, and what the public call does with one that breaks its word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "hal/fake/scripted.h"
#include "tests/contract/device_cases.h"
#include "tests/support/scripted_session.h"
#include "tests/support/session_log.h"

namespace orthonav {
namespace {

using orthonav::test::DeviceCase;
using orthonav::test::play;
using orthonav::test::SessionLog;
using ::testing::HasSubstr;

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
    EXPECT_LT(seeing, pixels) << "the cases' cameras see nothing in their corners";
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
    const auto answer = headset_->cameras().next(frame);
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
  std::erase_if(all, [](const DeviceCase& device) {
    return device.depth_cameras == 0 && device.name != "sim";
  });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, DepthContract, ::testing::ValuesIn(cases()),
                         [](const auto& device) { return device.param.name; });

/// A frame that keeps every promise after `good_frame(0)`.
DepthFrame good_frame(int index) {
  DepthFrame frame;
  frame.sequence = 4 + index;
  frame.map_epoch = 2;
  frame.time = orthonav::test::scripted_time(index);
  frame.range_mm = DepthImage(20, 18, 800);
  frame.brightness = DepthImage(20, 18, 70);
  frame.world_from_rig = orthonav::test::scripted_pose(index);
  return frame;
}

struct Broken {
  std::string name;
  std::function<void(DepthFrame&)> spoil;
  std::string says;
};

class BrokenDepth : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenDepth, IsReportedAndLeavesAnEmptyFrame) {
  DepthFrame broken = good_frame(1);
  GetParam().spoil(broken);
  fake::ManualClock clock(Timestamp::max());
  fake::ScriptedDepth camera(
      {orthonav::test::scripted_depth_camera(DepthStream::kLongThrow, 20, 18),
       {good_frame(0), broken, good_frame(2)}},
      clock);
  DepthFrame frame;
  ASSERT_EQ(*camera.next(frame), Next::kFrame);
  const auto answer = camera.next(frame);
  ASSERT_FALSE(answer.ok());
  EXPECT_THAT(answer.error().message, HasSubstr("depth long-throw: " + GetParam().says));
  EXPECT_TRUE(frame.range_mm == DepthImage());
  EXPECT_TRUE(frame.brightness == DepthImage());
  EXPECT_FALSE(frame.world_from_rig.has_value());
  ASSERT_TRUE(camera.next(frame).ok()) << "the stream goes on";
  EXPECT_EQ(frame.sequence, 6);
  EXPECT_EQ(*camera.next(frame), Next::kEnd);
  EXPECT_EQ(*camera.next(frame), Next::kEnd);
}

INSTANTIATE_TEST_SUITE_P(
    Every, BrokenDepth,
    ::testing::Values(
        Broken{"TimeBack", [](DepthFrame& f) { f.time = good_frame(0).time; }, "time 1.0000"},
        Broken{"SequenceBack", [](DepthFrame& f) { f.sequence = 4; },
               "sequence number 4 does not come after 4"},
        Broken{"MapBack", [](DepthFrame& f) { f.map_epoch = 1; }, "map epoch 1 comes after 2"},
        Broken{"WrongSize", [](DepthFrame& f) { f.range_mm = DepthImage(18, 20); },
               "range image is 18x20 px, its calibration 20x18 px"},
        Broken{"ShortBuffer", [](DepthFrame& f) { f.range_mm.pixels.pop_back(); },
               "range image holds 718 bytes, must be 720"},
        Broken{"WrongBrightness", [](DepthFrame& f) { f.brightness = DepthImage(20, 17); },
               "brightness image is 20x17 px"},
        Broken{"HollowBrightness", [](DepthFrame& f) { f.brightness.pixels.clear(); },
               "brightness image holds 0 bytes"},
        Broken{"NanPose",
               [](DepthFrame& f) {
                 f.world_from_rig = Transform<World, Rig>(
                     Mat3::identity(), {std::numeric_limits<double>::quiet_NaN(), 0, 0});
               },
               "head pose at 1.0333"},
        Broken{
            "MirroredPose",
            [](DepthFrame& f) {
              f.world_from_rig = Transform<World, Rig>({{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}}, {});
            },
            "head pose at 1.0333"}),
    [](const auto& broken) { return broken.param.name; });

TEST(DepthCalibration, PutsARangeAlongItsRay) {
  DepthCalibration camera;
  camera.width_px = 2;
  camera.height_px = 1;
  camera.rays = {DepthCalibration::ray_through({0.75, 0.0}), DepthCalibration::Ray{}};
  const auto point = camera.point_at(0, 0, 1000);
  ASSERT_TRUE(point.has_value());
  EXPECT_LT((point->v - Vec3{0.6, 0.0, 0.8}).norm(), 1e-7) << "a metre from the camera, z is less";
  EXPECT_FALSE(camera.point_at(0, 0, 0).has_value()) << "nothing measured";
  EXPECT_FALSE(camera.point_at(1, 0, 1000).has_value()) << "nothing seen";
}

}  // namespace
}  // namespace orthonav
