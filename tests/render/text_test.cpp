#include <gtest/gtest.h>

#include <algorithm>

#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

TEST(Text, StandsAtOnePlaceInSpaceForBothEyes) {
  TestRenderer renderer(400, 240);
  Scene scene;
  TextItem text;
  text.label = 601;
  text.position = {0.02f, 0.01f, -0.5f};
  text.height_m = 0.03f;
  text.runs = {{"I", {}}};
  scene.texts.push_back(text);
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  std::vector<LabelImage> labels;
  ASSERT_TRUE(test::is_ok(renderer->draw_labels(scene, eyes, labels)));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto extent = extent_of(labels[i], 601);
    ASSERT_TRUE(extent);
    const auto foot = project(eyes[i], text.position, 400, 240);
    EXPECT_NEAR(extent->centre_x_px, foot->x_px, 0.6);
    EXPECT_NEAR(extent->bottom_px, foot->y_px, 1.0);
    EXPECT_NEAR(extent->bottom_px - extent->top_px, 0.03 / 0.5 * 400, 1.01);
  }
}

TEST(Text, IsSharpFromHalfToFourTimesItsSize) {
  TestRenderer renderer(640, 384);
  for (const float height_m : {0.0125f, 0.025f, 0.05f, 0.1f, 0.2f}) {
    Scene scene;
    TextItem text;
    text.position = {-0.1f, -0.3f * height_m, -1};
    text.height_m = height_m;
    text.runs = {{"H", {1, 1, 1, 1}}};
    scene.texts.push_back(text);
    const RgbaImage image = renderer.draw(scene, TestRenderer::straight_ahead());
    // Along a row that cuts the stems, edges are at most two pixels of grey on each of four flanks.
    const int row = 384 / 2 - 2;
    int grey = 0;
    int white = 0;
    for (int x = 0; x < 640; ++x) {
      const int value = pixel(image, x, row)[0];
      grey += value > 20 && value < 235;
      white += value >= 235;
    }
    EXPECT_LE(grey, 8) << height_m;
    // Both stems are there: two pixels of grey at the least, thick white ones above.
    EXPECT_GE(grey + white, 4) << height_m;
    if (height_m > 0.02f) {
      EXPECT_GT(white, 2) << height_m;
    }
  }
}

/// The darkest pixel of a white text, in a white rim or none, on white ground.
int darkest_on_white(Blend blend, float rim) {
  TestRenderer renderer(200, 120, blend);
  Scene scene;
  TextItem text;
  text.position = {0, 0, -0.5f};
  text.height_m = 0.05f;
  text.rim = {1, 1, 1, rim};
  text.runs = {{"8", {}}};
  scene.texts.push_back(text);
  const RgbaImage white{200, 120, std::vector<std::uint8_t>(std::size_t{200} * 120 * 4, 255)};
  const RgbaImage image = renderer.draw(scene, TestRenderer::straight_ahead(), &white);
  return *std::min_element(image.pixels.begin(), image.pixels.end());
}

TEST(Text, HasADarkHaloOnBrightGroundWhereNoRimIsAndTheDisplayCanDarken) {
  EXPECT_LT(darkest_on_white(Blend::kOver, 0), 190);
  EXPECT_EQ(darkest_on_white(Blend::kOver, 1), 255);
  EXPECT_EQ(darkest_on_white(Blend::kAdditive, 0), 255) << "light cannot darken";
}

TEST(Text, IsNeverHiddenByASolid) {
  TestRenderer renderer;
  Scene scene = sphere_scene(MeshStyle::kSolid, {1, 0, 0, 1}, {0, 0, -0.5f}, 301);
  TextItem text;
  text.label = 601;
  text.position = {0, 0, -1};
  text.height_m = 0.05f;
  text.runs = {{"8", {}}};
  scene.texts.push_back(text);
  EXPECT_TRUE(extent_of(renderer.labels(scene, TestRenderer::straight_ahead()), 601));
}

TEST(Text, FixedToTheHeadStaysPutWhenTheHeadTurns) {
  TestRenderer renderer;
  Scene scene;
  TextItem text;
  text.label = 1101;
  text.place = TextPlace::kView;
  text.position = {0, -0.1f, -0.5f};
  text.height_m = 0.03f;
  text.runs = {{"done", {}}};
  scene.texts.push_back(text);
  const auto ahead = extent_of(renderer.labels(scene, TestRenderer::straight_ahead()), 1101);
  View rotated = look_at({0.3f, 0.5f, 0.2f}, {1, -1, 0.4f}, {0.2f, 1, 0}, 0.5f, 0.3f);
  const auto elsewhere = extent_of(renderer.labels(scene, rotated), 1101);
  ASSERT_TRUE(ahead && elsewhere);
  EXPECT_NEAR(ahead->centre_x_px, elsewhere->centre_x_px, 0.3);
  EXPECT_NEAR(ahead->centre_y_px, elsewhere->centre_y_px, 0.3);
}

}  // namespace
}  // namespace orthonav::render
