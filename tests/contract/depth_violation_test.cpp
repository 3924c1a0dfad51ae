// How the public call handles a depth camera that breaks its promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "hal/fake/scripted.h"
#include "tests/contract/device_cases.h"
#include "tests/support/scripted_session.h"

namespace orthonav {
namespace {

using ::testing::HasSubstr;

// Otherwise no test would show that a pixel without a direction is allowed.
TEST(DepthCases, SeeNothingInTheirCorners) {
  for (const auto& device : orthonav::test::device_cases()) {
    if (device.depth_cameras == 0) {
      continue;
    }
    const auto headset = device.open();
    for (const DepthCamera* camera : headset->depth_cameras()) {
      EXPECT_EQ(camera->calibration().rays.front()[2], 0.0F) << device.name;
    }
  }
}

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
