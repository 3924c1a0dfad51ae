#include "nav/tracking/tag_pose.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

constexpr double kTagM = 0.04;

std::array<Vec2, 4> seen_at(const CameraFromTag& pose) {
  std::array<Vec2, 4> seen;
  const auto corners = corners_in_marker(kTagM);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 p = pose.rotation * corners[i] + pose.translation_m;
    seen[i] = {p.x / p.z, p.y / p.z};
  }
  return seen;
}

/// Facing the camera (z of the tag against z of the camera), tilted.
CameraFromTag tilted(Vec3 tilt_rad) {
  const Mat3 facing{{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};
  return {facing * rotation_from_vector(tilt_rad), {0.05, -0.03, 0.45}};
}

TEST(PlanarPoses, HoldTheTruthFromExactCorners) {
  for (const Vec3 tilt : {Vec3{0.5, 0.2, 1.0}, Vec3{-0.3, 0.6, -2.0}, Vec3{0.05, 0.0, 0.3}}) {
    const auto poses = planar_poses(seen_at(tilted(tilt)), kTagM);
    ASSERT_TRUE(poses.has_value());
    EXPECT_LT(rotation_angle_rad((*poses)[0].rotation, tilted(tilt).rotation), 1e-6);
    EXPECT_LT(((*poses)[0].translation_m - tilted(tilt).translation_m).norm(), 1e-7);
  }
}

TEST(PlanarPoses, HoldTheOneThatLooksAlike) {
  const auto poses = planar_poses(seen_at(tilted({0.5, 0.2, 1.0})), kTagM);
  ASSERT_TRUE(poses.has_value());
  const Mat3& other = (*poses)[1].rotation;
  EXPECT_NEAR(other.determinant(), 1.0, 1e-9);
  EXPECT_GT(rotation_angle_rad(other, (*poses)[0].rotation), 0.5);
  // Its corners are seen within what perspective moves them by: a fiftieth of the tag.
  const auto a = seen_at((*poses)[0]);
  const auto b = seen_at((*poses)[1]);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT((a[i] - b[i]).norm(), 0.04 * kTagM / 0.45);
  }
  EXPECT_LT(other.column(2).dot((*poses)[1].translation_m), 0.0) << "it faces the camera too";
}

TEST(PlanarPoses, OfNoisyCornersAreAsFarAsTheTagIsSmall) {
  // 32 px wide, corners to 0.2 px: its size is known to 0.5 %, and so is its distance; by the
  // homography alone it is 4 % off, RMS.
  constexpr double kFocalPx = 360.0, kNoisePx = 0.2;
  Random random(5);
  double squared = 0.0;
  constexpr int kTags = 200;
  for (int i = 0; i < kTags; ++i) {
    const CameraFromTag truth =
        tilted({random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-3.0, 3.0)});
    auto seen = seen_at(truth);
    for (Vec2& corner : seen) {
      corner = corner +
               Vec2{random.normal(0, kNoisePx / kFocalPx), random.normal(0, kNoisePx / kFocalPx)};
    }
    const auto poses = planar_poses(seen, kTagM);
    ASSERT_TRUE(poses.has_value());
    squared += std::pow((*poses)[0].translation_m.norm() / truth.translation_m.norm() - 1.0, 2);
  }
  EXPECT_LT(std::sqrt(squared / kTags), 0.01);
}

TEST(PlanarPoses, RefuseWhatIsNoSquare) {
  EXPECT_FALSE(planar_poses({{{0, 0}, {0.1, 0}, {0.2, 0}, {0.3, 0}}}, kTagM).has_value());
  EXPECT_FALSE(planar_poses({{{0, 0}, {0, 0}, {0, 0}, {0, 0}}}, kTagM).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(planar_poses({{{nan, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}}, kTagM).has_value());
}

}  // namespace
}  // namespace orthonav::nav::tracking_paper_test
