#include <gmock/gmock.h>

#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;

RgbaImage plain_background(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  RgbaImage image{200, 120, {}};
  for (int i = 0; i < 200 * 120; ++i) {
    image.pixels.insert(image.pixels.end(), {red, green, blue, 255});
  }
  return image;
}

TEST(Background, ComesThroughUnchangedWhereThereIsNoHologram) {
  for (const Blend blend : {Blend::kAdditive, Blend::kOver}) {
    TestRenderer renderer(200, 120, blend);
    RgbaImage background{200, 120, {}};
    for (int i = 0; i < 200 * 120; ++i) {
      const auto value = static_cast<std::uint8_t>(i % 256);
      background.pixels.insert(background.pixels.end(),
                               {value, static_cast<std::uint8_t>(255 - value), 77, 255});
    }
    EXPECT_EQ(renderer.draw({}, TestRenderer::straight_ahead(), &background), background);
  }
}

TEST(Background, IsAddedToOrCovered) {
  Scene scene;
  scene.triangles.push_back(
      {501, {Float3{-9, -9, -1}, {9, -9, -1}, {0, 9, -1}}, {0.2f, 0, 0, 0.5f}});
  const RgbaImage background = plain_background(0, 188, 0);  // green 0.5 in linear light
  TestRenderer additive;
  TestRenderer over(200, 120, Blend::kOver);
  // Red 0.2 × 0.5 = 0.1: 89 in sRGB. Green stays, or halves to 0.25: 137, or 138 as a GPU rounds.
  EXPECT_THAT(pixel(additive.draw(scene, TestRenderer::straight_ahead(), &background), 100, 60),
              ElementsAre(89, 188, 0));
  EXPECT_THAT(pixel(over.draw(scene, TestRenderer::straight_ahead(), &background), 100, 60),
              ElementsAre(89, AnyOf(137, 138), 0));
}

TEST(Background, ShinesThroughAVeil) {
  Scene scene = sphere_scene(MeshStyle::kRim, {1, 1, 1, 0.35f}, {0, 0, -0.4f}, 201);
  const RgbaImage background = plain_background(0, 188, 0);
  TestRenderer additive;
  const auto with =
      pixel(additive.draw(scene, TestRenderer::straight_ahead(), &background), 100, 60);
  EXPECT_GT(with[1], 188);
  EXPECT_GT(with[0], 20);
}

TEST(Background, ReachesBothEyes) {
  TestRenderer renderer(200, 120, Blend::kOver);
  const RgbaImage left = plain_background(200, 0, 0);
  const RgbaImage right = plain_background(0, 0, 200);
  std::vector<RgbaImage> images;
  ASSERT_TRUE(test::is_ok(
      renderer->draw({}, stereo_pair(TestRenderer::straight_ahead()), {&left, &right}, images)));
  EXPECT_EQ(images.at(0), left);
  EXPECT_EQ(images.at(1), right);
}

}  // namespace
}  // namespace orthonav::render
