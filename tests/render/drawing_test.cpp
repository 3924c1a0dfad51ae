#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "render/float3.h"
#include "render/shapes.h"
#include "tests/render/test_renderer.h"

namespace orthonav::render {
namespace {

using testing::ElementsAre;

constexpr std::array<int, 3> kBlack = {0, 0, 0};

Scene line_scene(float width_m, Float3 from, Float3 to) {
  Scene scene;
  LineItem line;
  line.label = 401;
  line.points = {from, to};
  line.width_m = width_m;
  line.colour = {1, 1, 1, 1};
  scene.lines.push_back(line);
  return scene;
}

/// Light in a column of pixels, in full pixels (linear).
double light_in_column(const Image& image, int x_px) {
  double light = 0;
  for (int y = 0; y < image.height_px; ++y) {
    const double value = pixel(image, x_px, y)[1] / 255.0;
    light += value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  return light;
}

TEST(Line, IsAsWideAsTheWorldSays) {
  TestRenderer renderer;
  // 5 mm a pixel at 1 m: 30 mm are 6 px.
  const Image image = renderer.draw(line_scene(0.030f, {-0.4f, 0, -1}, {0.4f, 0, -1}),
                                    TestRenderer::straight_ahead());
  EXPECT_NEAR(light_in_column(image, 100), 6.0, 0.26);  // a quarter sample row on either side
}

TEST(Line, IsNeverThinnerThanOneAndAHalfPixels) {
  TestRenderer renderer;
  for (const float width_m : {0.0f, 0.001f, 0.004f}) {
    const Image image = renderer.draw(line_scene(width_m, {-0.4f, 0.003f, -1}, {0.4f, 0.003f, -1}),
                                      TestRenderer::straight_ahead());
    EXPECT_NEAR(light_in_column(image, 100), 1.5, 0.26) << width_m;
  }
  const Image thicker = renderer.draw(line_scene(0.012f, {-0.4f, 0, -1}, {0.4f, 0, -1}),
                                      TestRenderer::straight_ahead());
  EXPECT_GT(light_in_column(thicker, 100), 2.0) << "the twin: 2.4 px are above the floor";
}

TEST(Line, AddsItsLightOnceHoweverItCrossesItself) {
  TestRenderer renderer;
  Scene scene = line_scene(0.06f, {-0.2f, 0, -1}, {0.2f, 0, -1});
  scene.lines[0].points.push_back({-0.2f, 0.001f, -1});
  scene.lines[0].points.push_back({0.2f, -0.001f, -1});
  scene.lines[0].colour = {0.2f, 0.2f, 0.2f, 1};
  const Image once = renderer.draw(scene, TestRenderer::straight_ahead());
  EXPECT_THAT(pixel(once, 100, 60), ElementsAre(124, 124, 124));  // 0.2 in sRGB
  scene.lines.push_back(scene.lines[0]);
  const Image twice = renderer.draw(scene, TestRenderer::straight_ahead());
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
  for (Label label = 1; label <= 600; ++label) EXPECT_TRUE(extent_of(labels, label)) << label;
}

TEST(Triangle, ShowsFromBothSides) {
  TestRenderer renderer;
  Scene scene;
  scene.triangles.push_back(
      {501, {Float3{-0.1f, -0.1f, -1}, {0.1f, -0.1f, -1}, {0, 0.1f, -1}}, {}});
  const auto front = extent_of(renderer.labels(scene, TestRenderer::straight_ahead()), 501);
  std::swap(scene.triangles[0].corners[0], scene.triangles[0].corners[1]);
  const auto back = extent_of(renderer.labels(scene, TestRenderer::straight_ahead()), 501);
  ASSERT_TRUE(front && back);
  EXPECT_EQ(front->pixels, back->pixels);
  EXPECT_NEAR(front->centre_x_px, 100, 0.3);
}

Scene sphere_scene(MeshStyle style, Colour colour, Float3 at, Label label) {
  Scene scene;
  MeshItem item;
  item.label = label;
  item.mesh = std::make_shared<MeshData>(make_sphere(0.05f));
  item.world_from_model = placed_at(at);
  item.style = style;
  item.colour = colour;
  scene.meshes.push_back(item);
  return scene;
}

TEST(Mesh, SolidHidesALineBehindItAndAVeilDoesNot) {
  TestRenderer renderer;
  Scene scene = sphere_scene(MeshStyle::kSolid, {1, 0, 0, 1}, {0, 0, -1}, 301);
  const Scene line = line_scene(0.02f, {-0.3f, 0, -2}, {0.3f, 0, -2});
  scene.lines = line.lines;
  const auto middle = [&] {
    return renderer.labels(scene, TestRenderer::straight_ahead()).labels[60 * 200 + 100];
  };
  EXPECT_EQ(middle(), 301u);
  scene.meshes[0].style = MeshStyle::kRim;
  EXPECT_EQ(middle(), 401u);
  scene.meshes[0].style = MeshStyle::kSolid;
  scene.meshes[0].colour.a = 0.5f;
  EXPECT_EQ(middle(), 401u);
}

TEST(Mesh, RimIsBrightAtTheEdgeAndThinInside) {
  TestRenderer renderer;
  Scene scene = sphere_scene(MeshStyle::kRim, {1, 1, 1, 0.35f}, {0, 0, -0.4f}, 201);
  scene.meshes[0].mesh = std::make_shared<MeshData>(make_sphere(0.05f, 192, 96));
  const Image image = renderer.draw(scene, TestRenderer::straight_ahead());
  int brightest = 0;
  for (int x = 0; x < 100; ++x) brightest = std::max(brightest, pixel(image, x, 60)[0]);
  EXPECT_GT(brightest, 140);  // of a pixel that the edge covers in part
  EXPECT_LT(pixel(image, 100, 60)[0], 70);
  EXPECT_GT(pixel(image, 100, 60)[0], 20) << "there is an inside";
}

TEST(Mesh, VeilShowsOnlyItsNearestSurface) {
  TestRenderer renderer;
  Scene one = sphere_scene(MeshStyle::kRim, {1, 1, 1, 0.35f}, {0, 0, -1}, 201);
  Scene two = one;
  two.meshes.push_back(one.meshes[0]);
  two.meshes[1].world_from_model = placed_at({0, 0, -2}, 1.0f);
  EXPECT_EQ(pixel(renderer.draw(one, TestRenderer::straight_ahead()), 100, 60),
            pixel(renderer.draw(two, TestRenderer::straight_ahead()), 100, 60));
}

Image plain_background(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  Image image{200, 120, {}};
  for (int i = 0; i < 200 * 120; ++i) image.rgba.insert(image.rgba.end(), {red, green, blue, 255});
  return image;
}

TEST(Background, ComesThroughUnchangedWhereThereIsNoHologram) {
  for (const Blend blend : {Blend::kAdditive, Blend::kOver}) {
    TestRenderer renderer(200, 120, blend);
    Image background{200, 120, {}};
    for (int i = 0; i < 200 * 120; ++i) {
      const auto value = static_cast<std::uint8_t>(i % 256);
      background.rgba.insert(background.rgba.end(),
                             {value, static_cast<std::uint8_t>(255 - value), 77, 255});
    }
    EXPECT_EQ(renderer.draw({}, TestRenderer::straight_ahead(), &background), background);
  }
}

TEST(Background, IsAddedToOrCovered) {
  Scene scene;
  scene.triangles.push_back(
      {501, {Float3{-9, -9, -1}, {9, -9, -1}, {0, 9, -1}}, {0.2f, 0, 0, 0.5f}});
  const Image background = plain_background(0, 188, 0);  // green 0.5 in linear light
  TestRenderer additive;
  TestRenderer over(200, 120, Blend::kOver);
  // Red 0.2 × 0.5 = 0.1: 89 in sRGB. Green stays, or halves to 0.25: 137.
  EXPECT_THAT(pixel(additive.draw(scene, TestRenderer::straight_ahead(), &background), 100, 60),
              ElementsAre(89, 188, 0));
  EXPECT_THAT(pixel(over.draw(scene, TestRenderer::straight_ahead(), &background), 100, 60),
              ElementsAre(89, 137, 0));
}

TEST(Background, ShinesThroughAVeil) {
  Scene scene = sphere_scene(MeshStyle::kRim, {1, 1, 1, 0.35f}, {0, 0, -0.4f}, 201);
  const Image background = plain_background(0, 188, 0);
  TestRenderer additive;
  const auto with =
      pixel(additive.draw(scene, TestRenderer::straight_ahead(), &background), 100, 60);
  EXPECT_GT(with[1], 188);
  EXPECT_GT(with[0], 20);
}

TEST(Background, ReachesBothEyes) {
  TestRenderer renderer(200, 120, Blend::kOver);
  const Image left = plain_background(200, 0, 0);
  const Image right = plain_background(0, 0, 200);
  std::vector<Image> images;
  std::string error;
  ASSERT_TRUE(renderer->draw({}, stereo_pair(TestRenderer::straight_ahead()), {&left, &right},
                             images, error))
      << error;
  EXPECT_EQ(images.at(0), left);
  EXPECT_EQ(images.at(1), right);
}

/// Everything at once, overlapping.
Scene crowded_scene() {
  Scene scene = sphere_scene(MeshStyle::kRim, {0.9f, 0.8f, 0.7f, 0.35f}, {0, 0, -1}, 201);
  const auto add = [&](Scene more) {
    scene.meshes.insert(scene.meshes.end(), more.meshes.begin(), more.meshes.end());
    scene.lines.insert(scene.lines.end(), more.lines.begin(), more.lines.end());
  };
  add(sphere_scene(MeshStyle::kRim, {0.4f, 0.8f, 0.7f, 0.5f}, {0.03f, 0, -0.98f}, 202));
  add(sphere_scene(MeshStyle::kSolid, {0.1f, 0.3f, 1, 1}, {-0.05f, 0.02f, -1}, 301));
  add(sphere_scene(MeshStyle::kSolid, {0.1f, 0.7f, 0.2f, 1}, {-0.02f, 0.05f, -1}, 302));
  add(line_scene(0.02f, {-0.3f, -0.1f, -0.9f}, {0.3f, 0.1f, -1.2f}));
  add(line_scene(0.02f, {-0.3f, 0.1f, -0.9f}, {0.3f, -0.1f, -1.2f}));
  scene.lines[0].colour = {0.31f, 0.02f, 0.17f, 0.7f};
  scene.lines[1].colour = {0.07f, 0.43f, 0.11f, 0.6f};
  scene.lines[1].label = 402;
  for (Label k = 0; k < 3; ++k) {
    const float shift = 0.05f * static_cast<float>(k);
    scene.triangles.push_back(
        {501 + k,
         {Float3{-0.2f + shift, -0.1f, -1}, {0.2f, -0.1f, -1}, {0, 0.15f, -1}},
         {0.21f, 0.13f * static_cast<float>(k), 0.3f, 0.3f}});
    TextItem text;
    text.label = 601 + k;
    text.position = {0.01f * static_cast<float>(k), shift - 0.05f, -1};
    text.height_m = 0.05f;
    text.runs = {{"12.4°", {0.3f, 0.4f, 0.2f * static_cast<float>(k), 0.8f}}};
    text.rim = {0.5f, 0.1f, 0, 0.9f};
    scene.texts.push_back(text);
  }
  return scene;
}

TEST(Order, OfSubmissionNeverChangesAFrame) {
  for (const Blend blend : {Blend::kAdditive, Blend::kOver}) {
    TestRenderer renderer(200, 120, blend);
    Scene scene = crowded_scene();
    const Image image = renderer.draw(scene, TestRenderer::straight_ahead());
    const LabelImage labels = renderer.labels(scene, TestRenderer::straight_ahead());
    std::reverse(scene.meshes.begin(), scene.meshes.end());
    std::reverse(scene.lines.begin(), scene.lines.end());
    std::reverse(scene.triangles.begin(), scene.triangles.end());
    std::rotate(scene.texts.begin(), scene.texts.begin() + 1, scene.texts.end());
    EXPECT_EQ(renderer.draw(scene, TestRenderer::straight_ahead()), image);
    EXPECT_EQ(renderer.labels(scene, TestRenderer::straight_ahead()), labels);
    scene.texts.pop_back();
    EXPECT_NE(renderer.draw(scene, TestRenderer::straight_ahead()), image) << "the twin";
  }
}

TEST(Frames, RepeatToTheBit) {
  TestRenderer renderer;
  const Image first = renderer.draw(crowded_scene(), TestRenderer::straight_ahead());
  TestRenderer other;
  EXPECT_EQ(renderer.draw(crowded_scene(), TestRenderer::straight_ahead()), first);
  EXPECT_EQ(other.draw(crowded_scene(), TestRenderer::straight_ahead()), first);
}

TEST(Eyes, TogetherSeeWhatEachSeesAlone) {
  TestRenderer renderer(200, 120, Blend::kOver);
  Scene scene = crowded_scene();
  // Text turns to the point between the eyes, and what lies farther is told from there; one of a
  // kind has no order.
  scene.texts.clear();
  scene.lines.resize(1);
  scene.triangles.resize(1);
  const std::vector<View> eyes = stereo_pair(TestRenderer::straight_ahead());
  std::vector<Image> both;
  std::string error;
  ASSERT_TRUE(renderer->draw(scene, eyes, {}, both, error)) << error;
  EXPECT_EQ(both.at(0), renderer.draw(scene, eyes[0]));
  EXPECT_EQ(both.at(1), renderer.draw(scene, eyes[1]));
  EXPECT_NE(both.at(0), both.at(1)) << "the twin";
}

TEST(Eyes, BothSeeASurfaceThatFillsTheView) {
  TestRenderer renderer;
  Scene scene;
  scene.triangles.push_back({501, {Float3{-9, -9, -1}, {9, -9, -1}, {0, 9, -1}}, {}});
  std::vector<LabelImage> labels;
  std::string error;
  ASSERT_TRUE(
      renderer->draw_labels(scene, stereo_pair(TestRenderer::straight_ahead()), labels, error));
  for (const LabelImage& eye : labels) EXPECT_EQ(extent_of(eye, 501)->pixels, 200u * 120u);
}

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
  std::string error;
  ASSERT_TRUE(renderer->draw_labels(scene, eyes, labels, error)) << error;
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
    const Image image = renderer.draw(scene, TestRenderer::straight_ahead());
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
    if (height_m > 0.02f) {
      EXPECT_GT(white, 2) << height_m;
    }
  }
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
  View turned = look_at({0.3f, 0.5f, 0.2f}, {1, -1, 0.4f}, {0.2f, 1, 0}, 0.5f, 0.3f);
  const auto elsewhere = extent_of(renderer.labels(scene, turned), 1101);
  ASSERT_TRUE(ahead && elsewhere);
  EXPECT_NEAR(ahead->centre_x_px, elsewhere->centre_x_px, 0.3);
  EXPECT_NEAR(ahead->centre_y_px, elsewhere->centre_y_px, 0.3);
}

TEST(Labels, HaveTheirExactValuesAndNothingBetween) {
  TestRenderer renderer;
  Scene scene = crowded_scene();
  scene.triangles[0].label = 0xfffffffe;
  const LabelImage labels = renderer.labels(scene, TestRenderer::straight_ahead());
  for (const Label label : labels.labels) {
    const bool known = label == 0 || (label >= 201 && label <= 202) || label == 301 ||
                       label == 302 || label == 401 || label == 402 || label == 502 ||
                       label == 503 || (label >= 601 && label <= 603) || label == 0xfffffffe;
    EXPECT_TRUE(known) << label;
  }
  EXPECT_TRUE(extent_of(labels, 0xfffffffe));
}

TEST(Frames, OfOneSampleShowTheSameThings) {
  TestRenderer renderer(200, 120, Blend::kAdditive, 1);
  const Image image = renderer.draw(line_scene(0.03f, {-0.4f, 0, -1}, {0.4f, 0, -1}),
                                    TestRenderer::straight_ahead());
  EXPECT_THAT(pixel(image, 100, 60), ElementsAre(255, 255, 255));
  EXPECT_EQ(pixel(image, 100, 20), kBlack);
}

}  // namespace
}  // namespace orthonav::render
