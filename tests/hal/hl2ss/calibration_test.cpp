#include "hal/hl2ss/calibration.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "hal/hl2ss/protocol.h"
#include "hal/sim/cameras/hololens2.h"

namespace orthonav::hl2ss {
namespace {

using ::testing::HasSubstr;

std::vector<std::uint8_t> left_answer() {
  const StereoCalibration calibration = sim::hololens2_calibration();
  return calibration_bytes(calibration.left, calibration.left_from_rig.row_major());
}

std::string refusal(std::vector<std::uint8_t> answer) {
  const auto read = read_left_calibration(answer);
  return read ? "accepted" : read.error().message;
}

TEST(Calibration, ComesBackInSinglePrecision) {
  const StereoCalibration calibration = sim::hololens2_calibration();
  const auto answer = calibration_bytes(calibration.right, calibration.right_from_rig.row_major());
  ASSERT_EQ(answer.size(), 4'915'280u);
  const auto read = read_right_calibration(answer);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const Vec2 pixel{123.4, 311.9};
  EXPECT_LT((*read->camera.unproject(pixel) - *calibration.right.unproject(pixel)).norm(), 1e-6);
  EXPECT_LT((read->camera_from_rig.translation() - calibration.right_from_rig.translation()).norm(),
            1e-7);
  EXPECT_LT(
      rotation_angle_rad(read->camera_from_rig.rotation(), calibration.right_from_rig.rotation()),
      1e-6);
}

TEST(Calibration, StandsAtTheCornersOfPixels) {
  const CameraModel camera = sim::hololens2_calibration().left;
  const auto answer = left_answer();
  // The entry of pixel (320, 240) is the direction at the continuous pixel (320, 240).
  const std::size_t at = 4 * (240 * 640 + 320);
  float x = 0.0f;
  std::memcpy(&x, answer.data() + at, 4);
  EXPECT_NEAR(static_cast<double>(x), camera.unproject({320.0, 240.0})->x, 1e-5);
  EXPECT_GT(std::abs(static_cast<double>(x) - camera.unproject({320.5, 240.5})->x), 1e-3)
      << "the twin: half a pixel is 0.0014";
}

TEST(Calibration, OfARealDeviceIsTaken) {
  const std::string folder =
      std::string(ORTHONAV_SHARED_DIR) + "/recordings/hololens2-calibration/rm_vlc_leftfront";
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "needs shared/recordings/hololens2-calibration";
  }
  const auto bytes_of = [&](const char* name) {
    std::ifstream in(folder + "/" + name, std::ios::binary);
    return std::vector<std::uint8_t>{std::istreambuf_iterator<char>(in), {}};
  };
  const auto interleaved = bytes_of("uv2xy.bin");
  const auto extrinsics = bytes_of("extrinsics.bin");
  ASSERT_EQ(interleaved.size(), 2 * 4 * kImageBytes);
  std::vector<std::uint8_t> answer(kCalibrationBytes);
  for (std::size_t i = 0; i < kImageBytes; ++i) {
    std::memcpy(&answer[4 * i], &interleaved[8 * i], 4);
    std::memcpy(&answer[4 * (kImageBytes + i)], &interleaved[8 * i + 4], 4);
  }
  std::copy(extrinsics.begin(), extrinsics.end(),
            answer.begin() + static_cast<std::ptrdiff_t>(8 * kImageBytes));
  const auto read = read_left_calibration(answer);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const std::size_t at = 8 * (240 * 640 + 320);
  float x = 0.0f;
  std::memcpy(&x, &interleaved[at], 4);
  EXPECT_NEAR(read->camera.unproject({320.0, 240.0})->x, static_cast<double>(x), 1e-5);
}

/// A device leaves (0, 0) at the edges where its mapping failed; that is no fold.
TEST(Calibration, WithZerosAtItsEdgesHasNoDirectionThere) {
  auto answer = left_answer();
  constexpr int kEdgePx = 6;
  unmap_edges(answer, kEdgePx);
  const auto read = read_left_calibration(answer);
  ASSERT_TRUE(read.ok()) << read.error().message;
  const auto whole = read_left_calibration(left_answer());
  ASSERT_TRUE(whole.ok());
  EXPECT_FALSE(read->camera.unproject({3.0, 240.0}).has_value());
  EXPECT_FALSE(read->camera.unproject({320.0, 477.0}).has_value());
  // Resampling between corners needs four in a row.
  for (const Vec2 pixel : {Vec2{320.3, 240.7}, Vec2{10.0, 240.0}, Vec2{320.0, 469.0}}) {
    ASSERT_TRUE(read->camera.unproject(pixel).has_value()) << pixel.x << " " << pixel.y;
    EXPECT_EQ(read->camera.unproject(pixel), whole->camera.unproject(pixel));
  }
}

TEST(Calibration, MayLookStraightAhead) {
  const auto camera =
      CameraModel::from_brown_conrady({640, 480, 360.0, 360.0, 320.0, 240.0, 0, 0, 0, 0, 0});
  ASSERT_TRUE(camera.ok());
  auto answer = calibration_bytes(*camera, Transform<LeftCamera, Rig>{}.row_major());
  // The corner of pixel (320, 240): zero to the bit.
  for (const std::size_t table : {std::size_t{0}, 4 * kImageBytes}) {
    std::memset(answer.data() + table + 4 * (240 * 640 + 320), 0, 4);
  }
  const auto read = read_left_calibration(answer);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_TRUE(read->camera.unproject({320.0, 240.0}).has_value());
}

TEST(Calibration, OfTheWrongSizeIsRefused) {
  auto answer = left_answer();
  answer.pop_back();
  EXPECT_THAT(refusal(answer), HasSubstr("4915279 bytes, must be 4915280"));
  answer.resize(4'915'284);
  EXPECT_THAT(refusal(answer), HasSubstr("must be 4915280"));
  EXPECT_THAT(refusal({}), HasSubstr("0 bytes"));
}

TEST(Calibration, ThatIsNoCameraOrNoRigidMotionIsRefused) {
  const auto spoiled = [](std::size_t at, float value) {
    auto answer = left_answer();
    std::memcpy(answer.data() + at, &value, 4);
    return refusal(std::move(answer));
  };
  constexpr std::size_t kExtrinsicsAt = 2 * kImageBytes * 4;
  EXPECT_THAT(spoiled(kExtrinsicsAt, 5.0f), HasSubstr("extrinsics"));
  EXPECT_THAT(spoiled(kExtrinsicsAt + 12, 1.0f), HasSubstr("last column"));
  EXPECT_THAT(spoiled(kExtrinsicsAt + 48, std::numeric_limits<float>::quiet_NaN()),
              HasSubstr("not finite"));
  EXPECT_NE(spoiled(400, std::numeric_limits<float>::infinity()), "accepted");
  auto nothing = left_answer();
  std::fill(nothing.begin(), nothing.begin() + 2 * kImageBytes * 4, std::uint8_t{0});
  EXPECT_NE(refusal(nothing), "accepted") << "every pixel looks the same way";
}

}  // namespace
}  // namespace orthonav::hl2ss
