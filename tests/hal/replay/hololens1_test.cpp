#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/fake/scripted.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/hololens1_folder.h"

namespace orthonav::replay {
namespace {

using orthonav::test::Hololens1Folder;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Float32 on the unit plane, and a mean of four neighbours in place of what lies between them.
constexpr double kDirection = 1e-5;
// Six significant digits of entries up to 1, and of metres up to 1.
constexpr double kSixDigits = 3e-6;

/// Two cameras that see differently, lie differently, and are not square to anything.
StereoCalibration skewed_cameras() {
  const auto camera = [](double fx_px, double cx_px, double k1) {
    BrownConrady p;
    p.width_px = 640;
    p.height_px = 480;
    p.fx_px = fx_px;
    p.fy_px = fx_px + 3.0;
    p.cx_px = cx_px;
    p.cy_px = 233.0;
    p.k1 = k1;
    p.p1 = 0.001;
    return *CameraModel::from_brown_conrady(p);
  };
  return {camera(448.0, 331.0, -0.03),
          camera(455.0, 312.0, -0.02),
          {rotation_from_vector({0.1, -0.2, 1.5}), {0.01, 0.02, -0.03}},
          {rotation_from_vector({-0.3, 0.1, -1.4}), {-0.09, 0.015, 0.02}}};
}

std::vector<StereoFrame> frames_of_noise() {
  std::vector<StereoFrame> frames;
  Random random(4);
  for (int i = 0; i < 4; ++i) {
    StereoFrame frame;
    frame.sequence = i;
    frame.time = Timestamp(std::chrono::milliseconds(33 * i));
    frame.left = GreyImage(640, 480);
    frame.right = GreyImage(640, 480);
    for (GreyImage* image : {&frame.left, &frame.right}) {
      for (std::uint8_t& pixel : image->pixels) {
        pixel = static_cast<std::uint8_t>(random.next());
      }
    }
    if (i != 2) {
      frame.world_from_rig =
          Transform<World, Rig>(rotation_from_vector({0.2 * i, 0.5, -0.1}), {0.1 * i, 0.4, -0.7});
    }
    frames.push_back(frame);
  }
  return frames;
}

template <class A, class B>
void expect_near(const Transform<A, B>& actual, const Transform<A, B>& expected) {
  const auto a = actual.row_major();
  const auto e = expected.row_major();
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(a[i], e[i], kSixDigits) << i;
  }
}

void expect_near(const CameraModel& actual, const CameraModel& expected) {
  for (std::size_t i = 0; i < expected.lookup().size(); i += 997) {
    EXPECT_LT((actual.lookup()[i] - expected.lookup()[i]).norm(), kDirection) << i;
  }
  const std::size_t last = expected.lookup().size() - 1;
  EXPECT_LT((actual.lookup()[last] - expected.lookup()[last]).norm(), kDirection);
}

std::string refusal(const Hololens1Folder& folder) {
  const auto opened = ReplayHeadset::open(folder.path());
  return opened.ok() ? "accepted" : opened.error().message;
}

TEST(Hololens1, ComesBackAsItWasWritten) {
  const StereoCalibration calibration = skewed_cameras();
  const std::vector<StereoFrame> frames = frames_of_noise();
  const Hololens1Folder folder(calibration, frames);
  const auto replay = ReplayHeadset::open(folder.path());
  ASSERT_TRUE(replay.ok()) << replay.error().message;
  const StereoCalibration& read = (*replay)->cameras()->calibration();
  expect_near(read.left, calibration.left);
  expect_near(read.right, calibration.right);
  expect_near(read.left_from_rig, calibration.left_from_rig);
  expect_near(read.right_from_rig, calibration.right_from_rig);
  StereoFrame frame;
  for (const StereoFrame& expected : frames) {
    const auto next = (*replay)->cameras()->next(frame);
    ASSERT_TRUE(next.ok() && *next == Next::kFrame);
    EXPECT_EQ((*replay)->file_ticks_100ns(frame.time),
              Hololens1Folder::kStart + ticks_100ns(expected.time));
    EXPECT_TRUE(frame.left == expected.left);
    EXPECT_TRUE(frame.right == expected.right);
    ASSERT_EQ(frame.world_from_rig.has_value(), expected.world_from_rig.has_value());
    if (frame.world_from_rig) {
      expect_near(*frame.world_from_rig, *expected.world_from_rig);
    }
  }
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kEnd);
  EXPECT_EQ((*replay)->summary().pairs_without_pose, 1);
}

TEST(Hololens1, BeginsANewMapWhereThePosesJump) {
  std::vector<StereoFrame> frames = frames_of_noise();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].world_from_rig = Transform<World, Rig>(
        Mat3::identity(), {i < 2 ? 0.0 : 0.423, 1e-5 * static_cast<double>(i), 0});
  }
  const Hololens1Folder folder(skewed_cameras(), frames);
  const auto replay = ReplayHeadset::open(folder.path());
  ASSERT_TRUE(replay.ok()) << replay.error().message;
  StereoFrame frame;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    ASSERT_EQ(*(*replay)->cameras()->next(frame), Next::kFrame);
    EXPECT_EQ(frame.map_epoch, i < 2 ? 0 : 1) << i;
  }
}

TEST(ReplayPace, FollowsTheWallInRealTime) {
  const Hololens1Folder folder(skewed_cameras(), frames_of_noise());
  fake::ManualClock wall;
  const auto replay = ReplayHeadset::open(folder.path(), {ReplayPace::kRealtime, &wall});
  ASSERT_TRUE(replay.ok());
  StereoFrame frame;
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kNone);
  wall.advance(std::chrono::milliseconds(34));  // it begins a nominal frame before its first pair
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kFrame);
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kNone);
  EXPECT_GE((*replay)->clock().now(), frame.time);
  wall.advance(std::chrono::milliseconds(66));  // two more: the first of them is missed
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kFrame);
  EXPECT_EQ(frame.sequence, 2);
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kNone);
  wall.advance(std::chrono::seconds(1));
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kFrame);
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kEnd);
}

TEST(ReplayPace, WaitsForEachStep) {
  const Hololens1Folder folder(skewed_cameras(), frames_of_noise());
  const auto replay = ReplayHeadset::open(folder.path(), {ReplayPace::kStepped, nullptr});
  ASSERT_TRUE(replay.ok());
  StereoFrame frame;
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kNone);
  (*replay)->step();
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kFrame);
  EXPECT_EQ(frame.sequence, 0);
  EXPECT_EQ(*(*replay)->cameras()->next(frame), Next::kNone);
  EXPECT_EQ((*replay)->clock().now(), frame.time);
}

/// Each convention read the other way round would be off by far more than the tolerance.
TEST(Hololens1, IsToldApartFromItsMirrorsAndTransposes) {
  const StereoCalibration calibration = skewed_cameras();
  const auto seen = *calibration.left.unproject({100.0, 50.0});
  const auto mirrored = *calibration.left.unproject({540.0, 430.0});
  EXPECT_GT((seen - mirrored).norm(), 100 * kDirection);
  const auto half_a_pixel = *calibration.left.unproject({100.5, 50.5});
  EXPECT_GT((seen - half_a_pixel).norm(), 50 * kDirection);
  const Mat3& rotation = calibration.left_from_rig.rotation();
  EXPECT_GT(rotation_angle_rad(rotation, rotation.transposed()), 0.1);
}

TEST(Hololens1, RefusesDamageInOneLine) {
  const auto frames = frames_of_noise();
  const Hololens1Folder folder(skewed_cameras(), frames);
  EXPECT_EQ(refusal(folder), "accepted");
  const std::string csv = folder.text("vlc_lf.csv");
  const auto damaged = [&](const std::string& text) {
    folder.write("vlc_lf.csv", text);
    const std::string said = refusal(folder);
    folder.write("vlc_lf.csv", csv);
    return said;
  };
  const std::string header = csv.substr(0, csv.find('\n') + 1);
  EXPECT_THAT(damaged("nonsense\n"), AllOf(HasSubstr("vlc_lf.csv: line 1"), HasSubstr("header")));
  EXPECT_THAT(damaged(header + "1,2,3\n"), HasSubstr("line 2: holds 3 columns, must be 50"));
  EXPECT_THAT(damaged(header), HasSubstr("holds no CameraViewTransform"));
  std::string mirrored = header + "132000000000000000,x,-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1";
  for (int i = 0; i < 2; ++i) {
    mirrored += ",1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1";
  }
  EXPECT_THAT(damaged(mirrored + "\n"), AllOf(HasSubstr("FrameToOrigin"), HasSubstr("mirrors")));
  std::string columns = header + "132000000000000000,x,1,0,0,5,0,1,0,0,0,0,1,0,0,0,0,1";
  for (int i = 0; i < 2; ++i) {
    columns += ",1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1";
  }
  EXPECT_THAT(damaged(columns + "\n"), HasSubstr("row vectors"));
  folder.write("vlc_rf_camera_space_projection.bin", "short");
  EXPECT_THAT(refusal(folder), HasSubstr("holds 5 bytes, must be 2457600"));
}

}  // namespace
}  // namespace orthonav::replay
