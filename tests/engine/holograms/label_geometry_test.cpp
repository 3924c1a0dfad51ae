#include "engine/holograms/labels/label_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orthonav::engine {
namespace {

using render::Float3;

constexpr float kExactly = 1e-5f;
constexpr SeenBox kBox{0, 0, 2, 1};

SeenOutline outline(std::initializer_list<SeenPoint> points, float radius = 0) {
  SeenOutline made;
  for (const SeenPoint p : points) {
    made.corners[made.count++] = p;
  }
  made.radius = radius;
  return made;
}

TEST(LabelGeometry, BoxesThatOnlyTouchDoNotOverlap) {
  EXPECT_TRUE(overlap(kBox, SeenBox{1.9f, 0.9f, 3, 3}));
  EXPECT_FALSE(overlap(kBox, SeenBox{2, 0, 3, 1}));
  EXPECT_FALSE(overlap(kBox, SeenBox{})) << "behind the eye";
  EXPECT_FALSE(overlap(grown(SeenBox{}, 5), kBox));
}

TEST(LabelGeometry, ADiscReachesAsFarAsItsRadius) {
  EXPECT_TRUE(overlap(outline({{-0.5f, 0.5f}}, 0.51f), kBox));
  EXPECT_FALSE(overlap(outline({{-0.5f, 0.5f}}, 0.49f), kBox));
}

TEST(LabelGeometry, ALinePassesACorner) {
  EXPECT_TRUE(overlap(outline({{-1, 0.5f}, {3, 0.6f}}), kBox)) << "through it, both ends outside";
  EXPECT_TRUE(overlap(outline({{-0.5f, 1.4f}, {0.6f, 0.5f}}), kBox));
  EXPECT_FALSE(overlap(outline({{-0.5f, 1.2f}, {0.5f, 2.2f}}), kBox));
  EXPECT_FALSE(overlap(outline({{-1, 0.5f}, {0.5f, 2}}), kBox)) << "its own box meets this one";
}

TEST(LabelGeometry, APatchIsConvexHullNotItsBox) {
  const SeenOutline patch = outline({{3, 0}, {4, 1}, {3, 2}, {2, 1}});
  EXPECT_TRUE(overlap(patch, SeenBox{2.5f, 0.8f, 2.6f, 0.9f}));
  EXPECT_TRUE(overlap(patch, SeenBox{0, -5, 9, 9})) << "all in it";
  EXPECT_FALSE(overlap(patch, SeenBox{2, 0, 2.4f, 0.5f})) << "in its box only";
}

TEST(LabelGeometry, SeesWithEachEye) {
  const auto views = render::stereo_pair(render::look_at({0, 0, 0.5f}, {}, {0, 1, 0}, 0.4f, 0.3f));
  const Eyes eyes(views);
  const Float3 origin{};
  const OutlineInEyes at = eyes.outline({&origin, 1}, 0.01f);
  // Half the distance between the eyes over the distance.
  EXPECT_NEAR(at[0].corners[0].x, 0.063f, kExactly);
  EXPECT_NEAR(at[1].corners[0].x, -0.063f, kExactly);
  EXPECT_NEAR(at[0].radius, 0.02f, kExactly);
  const Float3 behind{0, 0, 1};
  EXPECT_EQ(eyes.outline({&behind, 1}, 0)[0].count, 0u);
}

TEST(LabelGeometry, ATextsBoxIsAsLargeAsItLooks) {
  const auto views = render::stereo_pair(render::look_at({0, 0, 0.5f}, {}, {0, 1, 0}, 0.4f, 0.3f));
  const Eyes eyes(views);
  render::Matrix4 caps = render::kIdentity;  // cap heights of 1 cm, facing the head
  caps[0].x = caps[1].y = 0.01f;
  const BoxInEyes box = eyes.box(caps, {1, 0, 3, 1});
  for (const SeenBox& seen : box) {
    EXPECT_NEAR(seen.right - seen.left, 0.04f, kExactly);
    EXPECT_NEAR(seen.top - seen.bottom, 0.02f, kExactly);
  }
  EXPECT_TRUE(eyes.in_view(box));
  EXPECT_FALSE(eyes.in_view(eyes.box(caps, {15, 0, 18, 1}))) << "the left eye sees less there";
}

}  // namespace
}  // namespace orthonav::engine
