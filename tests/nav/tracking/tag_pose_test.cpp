#include "nav/tracking/tag_pose.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "base/random.h"
#include "tests/nav/published/paper_tracking.h"

namespace orthonav::nav::tracking_paper_test {
namespace {

TEST(TagGeometry, RecoversThePoseOfExactCorners) {
  const TagGeometry geometry(calibration());
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const PlacedTag tag{
        "tag36h11", 3, 0.05,
        test::facing(
            {random.uniform(-0.05, 0.05), random.uniform(-0.08, 0.08), random.uniform(-0.2, 0.1)},
            {random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-3, 3)})};
    const TagPair seen{left_corners(calibration(), tag), right_corners(calibration(), tag)};
    const auto pose = geometry.pose(seen, tag.size_m);
    ASSERT_TRUE(pose);
    // Corners invert to 1e-6 px.
    EXPECT_LT((pose->rig_from_marker.translation() - tag.rig_from_marker.translation()).norm(),
              1e-7);
    EXPECT_LT(rotation_angle_rad(pose->rig_from_marker.rotation(), tag.rig_from_marker.rotation()),
              1e-5);
    EXPECT_NEAR(pose->size_ratio, 1.0, 1e-6);
    EXPECT_LT(pose->gap_px, 1e-4);
    EXPECT_LT(geometry.residual_px(pose->rig_from_marker, seen, tag.size_m).value(), 1e-4);
  }
}

TEST(TagGeometry, NeedsEveryCorner) {
  const TagGeometry geometry(calibration());
  const PlacedTag tag = pointer_at(0);
  TagPair seen{left_corners(calibration(), tag), right_corners(calibration(), tag)};
  seen.right_px[2] = {-50, 20};
  EXPECT_FALSE(geometry.pose(seen, 0.05));
  seen.right_px[2] = {std::numeric_limits<double>::quiet_NaN(), 20};
  EXPECT_FALSE(geometry.pose(seen, 0.05));
}

TEST(TagGeometry, CovarianceMatchesWhatCornerNoiseDoes) {
  const TagGeometry geometry(calibration());
  constexpr double kNoisePx = 0.05;
  Random random(8);
  const PlacedTag tag = pointer_at(0);
  const TagPair exact{left_corners(calibration(), tag), right_corners(calibration(), tag)};
  const auto claimed = geometry.covariance(tag.rig_from_marker, exact, tag.size_m,
                                           kNoisePx * kNoisePx, kNoisePx * kNoisePx);
  ASSERT_TRUE(claimed);
  std::array<double, 6> squared{};
  constexpr int kDraws = 2000;
  for (int draw = 0; draw < kDraws; ++draw) {
    TagPair seen = exact;
    for (auto* corners : {&seen.left_px, &seen.right_px}) {
      for (Vec2& c : *corners) {
        c = c + Vec2{random.normal(0, kNoisePx), random.normal(0, kNoisePx)};
      }
    }
    const auto pose = geometry.pose(seen, tag.size_m);
    ASSERT_TRUE(pose);
    const Vec3 translation_m =
        pose->rig_from_marker.translation() - tag.rig_from_marker.translation();
    const Vec3 rotation_rad = vector_from_rotation(pose->rig_from_marker.rotation() *
                                                   tag.rig_from_marker.rotation().transposed());
    for (int i = 0; i < 3; ++i) {
      squared[static_cast<std::size_t>(i)] += translation_m[i] * translation_m[i] / kDraws;
      squared[static_cast<std::size_t>(i + 3)] += rotation_rad[i] * rotation_rad[i] / kDraws;
    }
  }
  // 2000 draws know a variance to 3 % (1 SD); to first order only, so 15 %.
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(squared[i] / (*claimed)[7 * i], 1.0, 0.15) << i;
  }
}

TEST(TagGeometry, TurnedCovarianceIsThatOfTheTurnedPose) {
  PoseCovariance covariance{};
  covariance[0] = 4.0;   // along x
  covariance[35] = 9.0;  // about z
  const Mat3 quarter = {{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};
  const PoseCovariance seen = rotated(covariance, quarter);
  EXPECT_NEAR(seen[0], 0.0, 1e-12);
  EXPECT_NEAR(seen[7], 4.0, 1e-12);
  EXPECT_NEAR(seen[35], 9.0, 1e-12);
}

}  // namespace
}  // namespace orthonav::nav::tracking_paper_test
