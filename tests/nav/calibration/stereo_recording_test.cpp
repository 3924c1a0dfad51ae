#include "nav/calibration/stereo_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/tag_body_scene.h"

namespace orthonav::nav::stereo_recording_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNoisePx = 0.05;

/// Four by three tags of 30 mm, 38 mm apart.
std::vector<BoardTag> board() {
  std::vector<BoardTag> tags;
  for (int i = 0; i < 12; ++i) {
    tags.push_back({{"tag36h11", i, 0.03},
                    {Mat3::identity(), {0.038 * (i % 4 - 1.5), 0.038 * (1 - i / 4), 0}}});
  }
  return tags;
}

/// Cameras whose right one differs slightly from the device's calibration.
test::TagBodyScene scene(Vec3 rotation_rad, Vec3 translation_m = {}) {
  test::TagBodyScene made;
  const Transform<RightCamera, RightCamera> wrong(rotation_from_vector(rotation_rad),
                                                  translation_m);
  made.seen_by.right_from_rig = wrong * made.calibration.right_from_rig;
  made.noise_px = kNoisePx;
  for (const BoardTag& tag : board()) {
    made.tags.push_back(tag.definition);
    made.marker_from_tag.push_back(tag.board_from_tag);
  }
  return made;
}

std::vector<PairSightings> seen(const test::TagBodyScene& cameras, int pairs, std::uint64_t seed) {
  Random random(seed);
  std::vector<PairSightings> all;
  for (const auto& pose : test::turning(pairs)) {
    // Half as far turned, and all over the images.
    const Transform<Rig, Marker> held(
        rotation_from_vector(0.5 * vector_from_rotation(pose.rotation())),
        pose.translation() + Vec3{random.uniform(-0.15, 0.15), random.uniform(-0.17, 0.17), -0.1});
    all.push_back(cameras.seen(held, random));
  }
  return all;
}

TEST(StereoRecording, FindsByHowMuchTheRightCameraIsOff) {
  // 0.6 px across the lines, as a real unit was.
  const Vec3 rotation{0.0004, 0.6 / 360.0, -0.0003};
  const Vec3 translation{0.0001, -0.0002, 0.00005};
  double rotation_off = 0.0;
  double rotation_sigma = 0.0;
  constexpr int kTrials = 6;
  const test::TagBodyScene cameras = scene(rotation, translation);
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto found = calibrate_stereo(cameras.calibration, board(),
                                        seen(cameras, 40, static_cast<std::uint64_t>(trial)));
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_TRUE(found->is_off);
    EXPECT_GT(found->off_px, 0.6);  // more towards the edges, and the other turns add to it
    EXPECT_NEAR(
        found->off_px,
        std::sqrt(std::pow(found->epipolar_before_px, 2) - std::pow(found->epipolar_after_px, 2)),
        0.02);
    EXPECT_LT(found->off_sigma_px, 0.03);
    EXPECT_GT(found->epipolar_before_px, 0.5);
    // One coordinate of the right corner, and the left corner's along with it.
    EXPECT_NEAR(found->epipolar_after_px, std::sqrt(2.0) * kNoisePx, 0.01);
    EXPECT_LT((found->translation_m - translation).norm(), 4.0 * found->translation_sigma_m);
    EXPECT_EQ(found->judgement.verdict, Verdict::kNote);
    EXPECT_THAT(found->judgement.reason, HasSubstr("the device's calibration is off by 0."));
    rotation_off += (found->rotation_rad - rotation).squared_norm();
    rotation_sigma += found->rotation_sigma_rad * found->rotation_sigma_rad;
  }
  // 18 numbers, and the larger of two estimates is told: within a factor of two.
  EXPECT_LT(rotation_off / rotation_sigma, 2.0);
  EXPECT_GT(rotation_off / rotation_sigma, 0.2);
}

TEST(StereoRecording, LeavesAGoodCalibrationAlone) {
  const test::TagBodyScene cameras = scene({});
  int off = 0;
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    const auto found = calibrate_stereo(cameras.calibration, board(), seen(cameras, 40, seed));
    ASSERT_TRUE(found.ok()) << found.error().message;
    off += found->is_off ? 1 : 0;
    EXPECT_LT(found->off_px, 0.05);
    EXPECT_EQ(found->judgement.verdict, Verdict::kPass) << found->judgement.reason;
    EXPECT_THAT(found->judgement.reason, HasSubstr("holds"));
  }
  EXPECT_EQ(off, 0);
}

TEST(StereoRecording, FailsWhereTheBoardIsNotAsItSays) {
  // A board bent by 3 mm at its ends, read as flat.
  test::TagBodyScene cameras = scene({});
  for (std::size_t i = 0; i < cameras.marker_from_tag.size(); ++i) {
    const double x = cameras.marker_from_tag[i].translation().x / 0.057;
    cameras.marker_from_tag[i] = {
        cameras.marker_from_tag[i].rotation(),
        cameras.marker_from_tag[i].translation() + Vec3{0, 0, 0.02 * x * x}};
  }
  const auto found = calibrate_stereo(cameras.calibration, board(), seen(cameras, 40, 3));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_EQ(found->judgement.verdict, Verdict::kFail) << found->rms_px;
  EXPECT_THAT(found->judgement.reason, HasSubstr("is the board flat"));
}

TEST(StereoRecording, RefusesTooLittleAndWrongSizes) {
  const test::TagBodyScene cameras = scene({});
  const auto pairs = seen(cameras, 40, 4);
  const auto refusal = [&](std::span<const PairSightings> given) {
    const auto found = calibrate_stereo(cameras.calibration, board(), given);
    return found ? std::string() : found.error().message;
  };
  EXPECT_THAT(refusal(std::span(pairs).first(12)), HasSubstr("in 12 pairs, at least 20"));
  EXPECT_THAT(refusal({}), HasSubstr("in 0 pairs"));
  auto scaled = pairs;
  for (PairSightings& pair : scaled) {
    for (TagSighting& tag : pair) {
      if (tag.pose) {
        tag.pose->size_ratio *= 0.9;
      }
    }
  }
  EXPECT_THAT(refusal(scaled), HasSubstr("printed at 100 %"));
}

}  // namespace
}  // namespace orthonav::nav::stereo_recording_test
