#include <gmock/gmock.h>

#include "base/srgb.h"
#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

using ::testing::ElementsAre;

/// Light in a column of pixels, in full pixels (linear).
double light_in_column(const RgbaImage& image, int x_px) {
  double light = 0;
  for (int y = 0; y < image.height_px; ++y) {
    light += linear_from_srgb(pixel(image, x_px, y)[1] / 255.0);
  }
  return light;
}

TEST(Line, IsAsWideAsTheWorldSays) {
  TestRenderer renderer;
  // 5 mm a pixel at 1 m: 30 mm are 6 px.
  const RgbaImage image = renderer.draw(line_scene(0.030f, {-0.4f, 0, -1}, {0.4f, 0, -1}),
                                        TestRenderer::straight_ahead());
  EXPECT_NEAR(light_in_column(image, 100), 6.0, 0.02);
}

TEST(Line, IsNeverThinnerThanOneAndAHalfPixels) {
  TestRenderer renderer;
  for (const float width_m : {0.0f, 0.001f, 0.004f}) {
    const RgbaImage image =
        renderer.draw(line_scene(width_m, {-0.4f, 0.003f, -1}, {0.4f, 0.003f, -1}),
                      TestRenderer::straight_ahead());
    EXPECT_NEAR(light_in_column(image, 100), 1.5, 0.02) << width_m;
  }
  const RgbaImage thicker = renderer.draw(line_scene(0.012f, {-0.4f, 0, -1}, {0.4f, 0, -1}),
                                          TestRenderer::straight_ahead());
  EXPECT_GT(light_in_column(thicker, 100), 2.0) << "the twin: 2.4 px are above the floor";
}

TEST(Line, AddsItsLightOnceHoweverItCrossesItself) {
  TestRenderer renderer;
  Scene scene = line_scene(0.06f, {-0.2f, 0, -1}, {0.2f, 0, -1});
  scene.lines[0].points.push_back({-0.2f, 0.001f, -1});
  scene.lines[0].points.push_back({0.2f, -0.001f, -1});
  scene.lines[0].colour = {0.2f, 0.2f, 0.2f, 1};
  const RgbaImage once = renderer.draw(scene, TestRenderer::straight_ahead());
  EXPECT_THAT(pixel(once, 100, 60), ElementsAre(124, 124, 124));  // 0.2 in sRGB
  scene.lines.push_back(scene.lines[0]);
  const RgbaImage twice = renderer.draw(scene, TestRenderer::straight_ahead());
  EXPECT_GT(pixel(twice, 100, 60)[0], 150) << "the twin: two lines do add";
}

TEST(Line, HasRoundEndsAndNoGapsAtCorners) {
  TestRenderer renderer;
  Scene scene = line_scene(0.10f, {-0.2f, -0.1f, -1}, {0.0f, 0.1f, -1});
  scene.lines[0].points.push_back({0.2f, -0.1f, -1});
  const LabelImage labels = renderer.labels(scene, TestRenderer::straight_ahead());
  const auto extent = extent_of(labels, 401);
  ASSERT_TRUE(extent);
  // The corner at y = +0.1 m is 40 px from the top; its round join reaches 10 px further, where a
  // bevel would end at 7 px.
  EXPECT_NEAR(extent->top_px, 30, 1);
  EXPECT_NEAR(extent->left_px, 50, 1);
}

TEST(Line, ThatEndsBehindTheEyeIsCutNotMirrored) {
  TestRenderer renderer;
  const LabelImage labels = renderer.labels(line_scene(0.01f, {0.05f, 0, -1}, {0.05f, 0, 1}),
                                            TestRenderer::straight_ahead());
  const auto extent = extent_of(labels, 401);
  ASSERT_TRUE(extent);
  EXPECT_GE(extent->left_px, 108) << "nothing left of where it begins";
  EXPECT_EQ(extent->right_px, 200) << "runs out of the picture";
  const LabelImage behind = renderer.labels(line_scene(0.01f, {0.05f, 0, 0.5f}, {0.05f, 0, 1}),
                                            TestRenderer::straight_ahead());
  EXPECT_FALSE(extent_of(behind, 401));
}

TEST(Line, SeenFromItsEndIsADot) {
  TestRenderer renderer;
  const LabelImage labels =
      renderer.labels(line_scene(0.04f, {0, 0, -1}, {0, 0, -2}), TestRenderer::straight_ahead());
  const auto extent = extent_of(labels, 401);
  ASSERT_TRUE(extent);
  EXPECT_NEAR(extent->right_px - extent->left_px, 8, 1);
  EXPECT_NEAR(extent->bottom_px - extent->top_px, 8, 1);
}

TEST(Line, DashesMeasureAsLongAsTheGaps) {
  TestRenderer renderer;
  Scene scene = line_scene(0.010f, {-0.4f, 0, -1}, {0.4f, 0, -1});
  scene.lines[0].dash_m = 0.05f;  // 10 px on, 10 px off
  const LabelImage labels = renderer.labels(scene, TestRenderer::straight_ahead());
  int lit = 0;
  int edges = 0;
  for (int x = 30; x < 170; ++x) {
    const bool here = labels.labels[60 * 200 + static_cast<std::size_t>(x)] == 401;
    const bool before = labels.labels[60 * 200 + static_cast<std::size_t>(x) - 1] == 401;
    lit += here;
    edges += here != before;
  }
  EXPECT_NEAR(lit, 70, 7);
  EXPECT_NEAR(edges, 14, 1);
}

TEST(Line, MoreThanTwoHundredFiftyFiveAllShow) {
  TestRenderer renderer;
  Scene scene;
  for (int i = 0; i < 600; ++i) {
    const float x = -0.45f + 0.9f * static_cast<float>(i % 60) / 60;
    const float y = -0.25f + 0.5f * static_cast<float>(i / 60) / 10;
    Scene one = line_scene(0, {x, y, -1}, {x, y + 0.02f, -1});
    one.lines[0].label = static_cast<Label>(1 + i);
    scene.lines.push_back(one.lines[0]);
  }
  const LabelImage labels = renderer.labels(scene, TestRenderer::straight_ahead());
  for (Label label = 1; label <= 600; ++label) {
    EXPECT_TRUE(extent_of(labels, label)) << label;
  }
}

}  // namespace
}  // namespace orthonav::render
