#include <gtest/gtest.h>

#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

/// With computed coverage, meshes whose edges cross have an order too.
Scene crowded_scene_for(Edges edges) {
  Scene scene = crowded_scene();
  if (edges == Edges::kCoverage) {
    const MeshItem first = scene.meshes[0];
    scene.meshes.clear();
    scene.meshes.push_back(first);
  }
  return scene;
}

class EyesWithEdges : public ::testing::TestWithParam<Edges> {};
INSTANTIATE_TEST_SUITE_P(Eyes, EyesWithEdges, ::testing::Values(Edges::kCoverage, Edges::kSamples));

TEST_P(EyesWithEdges, TogetherSeeWhatEachSeesAlone) {
  TestRenderer renderer(200, 120, Blend::kOver, GetParam());
  Scene scene = crowded_scene_for(GetParam());
  // Text turns to the point between the eyes, and what lies farther is told from there; one of a
  // kind has no order.
  scene.texts.clear();
  scene.lines = {scene.lines[0]};
  scene.triangles = {scene.triangles[0]};
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  std::vector<RgbaImage> both;
  ASSERT_TRUE(test::is_ok(renderer->draw(scene, eyes, {}, both)));
  EXPECT_EQ(both.at(0), renderer.draw(scene, eyes[0]));
  EXPECT_EQ(both.at(1), renderer.draw(scene, eyes[1]));
  EXPECT_NE(both.at(0), both.at(1)) << "the twin";
}

TEST(Eyes, BothSeeASurfaceThatFillsTheView) {
  TestRenderer renderer;
  Scene scene;
  scene.triangles.push_back({501, {Float3{-9, -9, -1}, {9, -9, -1}, {0, 9, -1}}, {}});
  std::vector<LabelImage> labels;
  ASSERT_TRUE(test::is_ok(
      renderer->draw_labels(scene, stereo_pair(TestRenderer::straight_ahead()), labels)));
  for (const LabelImage& eye : labels) {
    EXPECT_EQ(extent_of(eye, 501)->pixels, 200u * 120u);
  }
}

/// What llvmpipe draws right in one pass: it puts lines and triangles of both eyes into the first
/// layer. Veils, solids and text go through the same targets, depth clears and resolve.
Scene meshes_and_texts() {
  Scene scene = crowded_scene();
  scene.lines.clear();
  scene.triangles.clear();
  return scene;
}

TEST(Eyes, InOnePassSeeWhatTheySeeInTurn) {
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  const Scene scene = meshes_and_texts();
  for (const Blend blend : {Blend::kAdditive, Blend::kOver}) {
    TestRenderer together(200, 120, blend, Edges::kSamples, EyesAPass::kTwo);
    TestRenderer in_turn(200, 120, blend, Edges::kSamples, EyesAPass::kOne);
    std::vector<RgbaImage> expected;
    std::vector<RgbaImage> actual;
    ASSERT_TRUE(test::is_ok(in_turn->draw(scene, eyes, {}, expected)));
    ASSERT_TRUE(test::is_ok(together->draw(scene, eyes, {}, actual)));
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const ColourDifference difference = compare_colour(expected.at(eye), actual.at(eye));
      EXPECT_TRUE(difference.alike()) << eye << ": " << difference.text();
    }
    EXPECT_FALSE(compare_colour(expected[0], actual[1]).alike()) << "the twin";
  }
}

TEST(Eyes, InOnePassHaveTheLabelsThatTheyHaveInTurn) {
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  TestRenderer together(200, 120, Blend::kAdditive, Edges::kSamples, EyesAPass::kTwo);
  TestRenderer in_turn(200, 120, Blend::kAdditive, Edges::kSamples, EyesAPass::kOne);
  std::vector<LabelImage> expected;
  std::vector<LabelImage> actual;
  ASSERT_TRUE(test::is_ok(in_turn->draw_labels(meshes_and_texts(), eyes, expected)));
  ASSERT_TRUE(test::is_ok(together->draw_labels(meshes_and_texts(), eyes, actual)));
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const LabelDifference difference = compare_labels(expected.at(eye), actual.at(eye));
    EXPECT_TRUE(difference.alike()) << eye << ": " << difference.text();
  }
  EXPECT_FALSE(compare_labels(expected[0], actual[1]).alike()) << "the twin";
}

TEST(Eyes, OnADeviceEachSeeWhatTheySeeOnOne) {
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  Scene refused = line_scene(0.06f, {-0.1f, 0, -1}, {0.1f, 0, -1});
  refused.lines[0].width_m = -1;
  for (const Blend blend : {Blend::kAdditive, Blend::kOver}) {
    TestRenderer apart(200, 120, blend);
    TestRenderer on_one(200, 120, blend, Edges::kCoverage, EyesAPass::kOne);
    std::vector<RgbaImage> expected;
    std::vector<RgbaImage> actual;
    for (const Scene& scene :
         {meshes_and_texts(), line_scene(0.06f, {-0.1f, 0, -1}, {0.1f, 0, -1})}) {
      ASSERT_TRUE(test::is_ok(on_one->draw(scene, eyes, {}, expected)));
      EXPECT_FALSE(apart->draw(refused, eyes, {}, actual).ok());
      ASSERT_TRUE(test::is_ok(apart->draw(scene, eyes, {}, actual)));
      EXPECT_EQ(actual.at(0).pixels, expected.at(0).pixels);
      EXPECT_EQ(actual.at(1).pixels, expected.at(1).pixels);
      EXPECT_NE(actual.at(0).pixels, expected.at(1).pixels) << "the twin";
    }
  }
}

/// Both eyes' labels in one picture, so that a line is found in whichever layer a driver put it.
LabelImage joined(const std::vector<LabelImage>& layers) {
  LabelImage all = layers.at(0);
  for (std::size_t i = 0; i < all.labels.size(); ++i) {
    all.labels[i] |= layers.at(1).labels[i];
  }
  return all;
}

TEST(Eyes, OfUnevenAnglesEachHaveTheirOwnScale) {
  // The line lies in the left half of the left eye's picture and in the right half of the right's.
  std::vector<View> eyes = {TestRenderer::straight_ahead(), TestRenderer::straight_ahead()};
  eyes[0].eye_from_world[3].x = -0.3f;
  eyes[1].eye_from_world[3].x = 0.6f;
  eyes[1].tan_up = eyes[1].tan_down = 0.6f;
  eyes[1].tan_left = eyes[1].tan_right = 1.0f;
  const Scene scene = line_scene(0.06f, {-0.1f, 0, -1}, {0.1f, 0, -1});
  for (const EyesAPass passes : {EyesAPass::kTwo, EyesAPass::kOne}) {
    TestRenderer renderer(200, 120, Blend::kAdditive, Edges::kSamples, passes);
    std::vector<LabelImage> layers;
    ASSERT_TRUE(test::is_ok(renderer->draw_labels(scene, eyes, layers)));
    const LabelImage labels = joined(layers);
    const auto height_at = [&](int x_px) {
      int height_px = 0;
      for (int y = 0; y < 120; ++y) {
        height_px += labels.labels[static_cast<std::size_t>(200 * y + x_px)] == 401 ? 1 : 0;
      }
      return height_px;
    };
    EXPECT_EQ(height_at(40), 12) << "200 pixels a metre";
    EXPECT_EQ(height_at(160), 6) << "100 pixels a metre";
  }
}

}  // namespace
}  // namespace orthonav::render
