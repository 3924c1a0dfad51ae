#include "render/projection.h"

#include <gtest/gtest.h>

#include "render/float3.h"

namespace orthonav::render {
namespace {

TEST(Projection, PutsStraightAheadInTheMiddle) {
  const auto point = project(View{}, {0, 0, -2}, 400, 300);
  ASSERT_TRUE(point);
  EXPECT_FLOAT_EQ(point->x_px, 200);
  EXPECT_FLOAT_EQ(point->y_px, 150);
  EXPECT_FLOAT_EQ(point->depth_m, 2);
}

TEST(Projection, FollowsUnevenHalfAngles) {
  View view;
  view.tan_left = 0.6f;
  view.tan_right = 0.4f;
  view.tan_up = 0.1f;
  view.tan_down = 0.3f;
  const auto point = project(view, {0.4f, 0.1f, -1}, 400, 300);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->x_px, 400, 1e-3);
  EXPECT_NEAR(point->y_px, 0, 1e-3);
}

TEST(Projection, ShowsNothingBehindTheEye) {
  EXPECT_FALSE(project(View{}, {0, 0, 1}, 400, 300));
  EXPECT_FALSE(project(View{}, {0, 0, -0.5f * kNearPlane_m}, 400, 300));
}

TEST(Projection, AgreesWithTheMatrixOfTheShaders) {
  View view = look_at({0.2f, 0.4f, 0.3f}, {0, 0, 0}, {0, 1, 0}, 0.4f, 0.25f);
  view.tan_left = 0.5f;
  view.tan_down = 0.35f;
  const Float3 p = {0.03f, -0.02f, 0.05f};
  const Float4 clip = clip_from_world(view) * Float4(p, 1);
  const auto point = project(view, p, 400, 300);
  ASSERT_TRUE(point);
  EXPECT_NEAR((clip.x / clip.w * 0.5f + 0.5f) * 400, point->x_px, 1e-3);
  EXPECT_NEAR((clip.y / clip.w * 0.5f + 0.5f) * 300, point->y_px, 1e-3);
  EXPECT_NEAR(clip.w, point->depth_m, 1e-5);
  EXPECT_NEAR(clip.z / clip.w, 1 - kNearPlane_m / point->depth_m, 1e-5);
}

TEST(Projection, UndoesARigidTransform) {
  const View view = look_at({0.2f, 0.4f, 0.3f}, {0, 0.1f, 0}, {0, 1, 0}, 0.4f, 0.25f);
  const Float3 p = {0.3f, -0.2f, 0.5f};
  const Float3 back =
      transformed(rigid_inverse(view.eye_from_world), transformed(view.eye_from_world, p));
  EXPECT_NEAR(length(back - p), 0, 1e-6);
}

TEST(Head, IsBetweenTheEyes) {
  const View between = look_at({0.2f, 0.4f, 0.3f}, {0, 0, 0}, {0, 1, 0}, 0.4f, 0.25f);
  const std::vector<View> eyes = stereo_pair(between, 0.063f);
  const Head head = head_of(eyes);
  EXPECT_NEAR(length(head.position - Float3{0.2f, 0.4f, 0.3f}), 0, 1e-6);
  EXPECT_NEAR(dot(head.up, head.right), 0, 1e-6);
  // The left eye sees the middle to its right.
  EXPECT_GT(project(eyes[0], {0, 0, 0}, 400, 300)->x_px, 200);
  EXPECT_LT(project(eyes[1], {0, 0, 0}, 400, 300)->x_px, 200);
}

}  // namespace
}  // namespace orthonav::render
