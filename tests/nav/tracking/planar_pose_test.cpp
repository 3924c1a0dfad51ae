#include "nav/tracking/planar_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "nav/tracking/tag_pose.h"

namespace orthonav::nav::planar_pose_test {
namespace {

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
}  // namespace orthonav::nav::planar_pose_test
