#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/test_host.h"
#include "tests/render/test_renderer.h"
#include "tests/render/test_scenes.h"

namespace orthonav::render {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth_px = 200;
constexpr int kHeight_px = 120;

/// A renderer on a host's device with the validation layer listening until it is gone.
struct Hosted {
  explicit Hosted(Blend blend = Blend::kAdditive, Edges edges = Edges::kCoverage,
                  EyesAPass eyes = EyesAPass::kProbe) {
    RendererOptions options;
    options.blend = blend;
    options.edges = edges;
    options.validation = true;
    options.messages = validation.sink();
    options.eyes_a_pass = eyes;
    options.cache_folder = "";
    auto made = Renderer::create(options, host);
    EXPECT_TRUE(test::is_ok(made));
    renderer = std::move(*made);
  }
  SilentValidation validation;
  TestHost host;
  std::unique_ptr<Renderer> renderer;
};

std::vector<View> eyes() { return stereo_pair(TestRenderer::straight_ahead()); }

void draw(Renderer& renderer, const Scene& scene, const std::vector<View>& views,
          const std::vector<std::uint32_t>& images) {
  ASSERT_TRUE(test::is_ok(renderer.prepare(scene)));
  ASSERT_TRUE(test::is_ok(renderer.draw(scene, views, images, HeadTexts::kDrawn)));
}

std::vector<RgbaImage> as_drawn_into_images(const Scene& scene, const std::vector<View>& views,
                                            Blend blend, Edges edges) {
  TestRenderer plain(kWidth_px, kHeight_px, blend, edges);
  std::vector<RgbaImage> images;
  EXPECT_TRUE(test::is_ok(plain->draw(scene, views, {}, images)));
  return images;
}

std::vector<std::vector<std::uint8_t>> both(TestImages& images, std::size_t index) {
  return {images.read(0, index), images.read(1, index)};
}

struct Way {
  const char* name;
  std::uint32_t layers;
  Edges edges;
  EyesAPass eyes;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }

class RendererOnAHostInEveryWay : public ::testing::TestWithParam<Way> {};

TEST_P(RendererOnAHostInEveryWay, DrawsTheSameBitsAsIntoImages) {
  const Way way = GetParam();
  const Scene scene = crowded_scene();
  const auto expected = as_drawn_into_images(scene, eyes(), Blend::kAdditive, way.edges);
  Hosted hosted(Blend::kAdditive, way.edges, way.eyes);
  TestImages images(hosted.renderer->objects(), VK_FORMAT_R8G8B8A8_SRGB, kWidth_px, kHeight_px,
                    way.layers);
  ASSERT_TRUE(test::is_ok(hosted.renderer->use(images.targets())));
  draw(*hosted.renderer, scene, eyes(), std::vector<std::uint32_t>(2 / way.layers, 1));
  const auto drawn = both(images, 1);
  EXPECT_TRUE(drawn[0] == expected[0].pixels);
  EXPECT_TRUE(drawn[1] == expected[1].pixels);
  EXPECT_TRUE(test::is_ok(hosted.renderer->finish()));
}

INSTANTIATE_TEST_SUITE_P(Hosts, RendererOnAHostInEveryWay,
                         ::testing::Values(Way{"chains", 1, Edges::kSamples, EyesAPass::kProbe},
                                           Way{"hard", 1, Edges::kHard, EyesAPass::kProbe},
                                           Way{"told_one", 1, Edges::kSamples, EyesAPass::kOne},
                                           Way{"layers", 2, Edges::kCoverage, EyesAPass::kProbe},
                                           Way{"layers_hard", 2, Edges::kHard, EyesAPass::kProbe},
                                           Way{"layers_resolved", 2, Edges::kSamples,
                                               EyesAPass::kProbe}),
                         [](const auto& way) { return std::string(way.param.name); });

/// llvmpipe resolves into the first layer alone and puts lines and triangles there, but a surface
/// in single samples it draws whole.
TEST(RendererOnAHost, DrawsBothLayersInOnePass) {
  const Scene scene = sphere_scene(MeshStyle::kRim, {0.2f, 0.8f, 1, 1}, {0, 0, -1}, 301);
  const auto expected = as_drawn_into_images(scene, eyes(), Blend::kAdditive, Edges::kHard);
  Hosted hosted(Blend::kAdditive, Edges::kHard, EyesAPass::kTwo);
  TestImages images(hosted.renderer->objects(), VK_FORMAT_R8G8B8A8_SRGB, kWidth_px, kHeight_px, 2);
  ASSERT_TRUE(test::is_ok(hosted.renderer->use(images.targets())));
  draw(*hosted.renderer, scene, eyes(), {1});
  const auto drawn = both(images, 1);
  EXPECT_TRUE(drawn[0] == expected[0].pixels);
  EXPECT_TRUE(drawn[1] == expected[1].pixels);
  EXPECT_FALSE(drawn[0] == drawn[1]);
  EXPECT_TRUE(test::is_ok(hosted.renderer->finish()));
}

TEST(RendererOnAHost, KeepsTwoFramesInFlightApart) {
  Hosted hosted;
  TestImages images(hosted.renderer->objects(), VK_FORMAT_R8G8B8A8_SRGB, kWidth_px, kHeight_px, 1);
  ASSERT_TRUE(test::is_ok(hosted.renderer->use(images.targets())));
  // The first frame's mesh is gone before the second is recorded: its copy must not be.
  Scene first = sphere_scene(MeshStyle::kSolid, {1, 0, 0, 1}, {-0.1f, 0, -1}, 301);
  const Scene copy_of_first = sphere_scene(MeshStyle::kSolid, {1, 0, 0, 1}, {-0.1f, 0, -1}, 301);
  const Scene second = sphere_scene(MeshStyle::kSolid, {0, 1, 0, 1}, {0.1f, 0, -1}, 302);
  draw(*hosted.renderer, first, eyes(), {0, 0});
  first = {};
  draw(*hosted.renderer, second, eyes(), {1, 1});
  const auto red = both(images, 0);
  const auto green = both(images, 1);
  const auto expected_red =
      as_drawn_into_images(copy_of_first, eyes(), Blend::kAdditive, Edges::kCoverage);
  const auto expected_green =
      as_drawn_into_images(second, eyes(), Blend::kAdditive, Edges::kCoverage);
  EXPECT_TRUE(red[0] == expected_red[0].pixels);
  EXPECT_TRUE(green[1] == expected_green[1].pixels);
  EXPECT_TRUE(test::is_ok(hosted.renderer->finish()));
}

/// Images that are read back are drawn between frames of the host, whose meshes must stay.
TEST(RendererOnAHost, AlsoReadsImagesBack) {
  Hosted hosted;
  TestImages images(hosted.renderer->objects(), VK_FORMAT_R8G8B8A8_SRGB, kWidth_px, kHeight_px, 1);
  ASSERT_TRUE(test::is_ok(hosted.renderer->use(images.targets())));
  const auto red = [] {
    return sphere_scene(MeshStyle::kSolid, {1, 0, 0, 1}, {-0.1f, 0, -1}, 301);
  };
  draw(*hosted.renderer, red(), eyes(), {0, 0});
  std::vector<RgbaImage> read;
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_TRUE(test::is_ok(hosted.renderer->draw(crowded_scene(), eyes(), {}, read)));
  }
  TestRenderer plain(RendererOptions{}.width_px, RendererOptions{}.height_px);
  std::vector<RgbaImage> expected;
  ASSERT_TRUE(test::is_ok(plain->draw(crowded_scene(), eyes(), {}, expected)));
  EXPECT_EQ(read, expected);
  EXPECT_TRUE(both(images, 0)[0] ==
              as_drawn_into_images(red(), eyes(), Blend::kAdditive, Edges::kCoverage)[0].pixels);
  EXPECT_TRUE(test::is_ok(hosted.renderer->finish()));
}

TEST(RendererOnItsOwnDevice, AlsoDrawsIntoTheImagesOfOthers) {
  TestRenderer renderer(kWidth_px, kHeight_px);
  TestImages images(renderer->objects(), VK_FORMAT_R8G8B8A8_SRGB, kWidth_px, kHeight_px, 1);
  const Scene scene = crowded_scene();
  ASSERT_TRUE(test::is_ok(renderer->use(images.targets())));
  draw(*renderer, scene, eyes(), {1, 1});
  const auto expected = as_drawn_into_images(scene, eyes(), Blend::kAdditive, Edges::kCoverage);
  const auto drawn = both(images, 1);
  EXPECT_TRUE(drawn[0] == expected[0].pixels);
  EXPECT_TRUE(drawn[1] == expected[1].pixels);
  EXPECT_TRUE(test::is_ok(renderer->finish()));
}

TEST(RendererOnAHost, TakesSwappedAndLinearFormats) {
  const Scene scene = crowded_scene();
  const auto expected = as_drawn_into_images(scene, eyes(), Blend::kAdditive, Edges::kCoverage);
  Hosted hosted;
  TestImages swapped(hosted.renderer->objects(), VK_FORMAT_B8G8R8A8_SRGB, kWidth_px, kHeight_px, 1);
  ASSERT_TRUE(test::is_ok(hosted.renderer->use(swapped.targets())));
  draw(*hosted.renderer, scene, eyes(), {0, 0});
  auto bytes = both(swapped, 0)[0];
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    std::swap(bytes[i], bytes[i + 2]);
  }
  EXPECT_TRUE(bytes == expected[0].pixels);
  EXPECT_GT(hosted.renderer->format_score(VK_FORMAT_R8G8B8A8_SRGB),
            hosted.renderer->format_score(VK_FORMAT_R16G16B16A16_SFLOAT));
  EXPECT_GT(hosted.renderer->format_score(VK_FORMAT_R16G16B16A16_SFLOAT),
            hosted.renderer->format_score(VK_FORMAT_R8G8B8A8_UNORM));
  EXPECT_EQ(hosted.renderer->format_score(VK_FORMAT_D32_SFLOAT), 0);
  EXPECT_TRUE(test::is_ok(hosted.renderer->finish()));
}

TEST(RendererOnAHost, WritesOpacityAsAlphaForACompositor) {
  Scene scene = sphere_scene(MeshStyle::kSolid, {1, 1, 1, 1}, {0, 0, -1}, 301);
  scene.triangles.push_back(
      {501, {Float3{-0.3f, -0.1f, -1}, {-0.1f, -0.1f, -1}, {-0.2f, 0.1f, -1}}, {1, 0, 0, 0.5f}});
  const auto over_black = as_drawn_into_images(scene, eyes(), Blend::kOver, Edges::kSamples);
  Hosted hosted(Blend::kPremultiplied);
  TestImages images(hosted.renderer->objects(), VK_FORMAT_R8G8B8A8_SRGB, kWidth_px, kHeight_px, 1);
  ASSERT_TRUE(test::is_ok(hosted.renderer->use(images.targets())));
  draw(*hosted.renderer, scene, eyes(), {0, 0});
  const auto bytes = both(images, 0)[0];
  const auto at = [&](int x, int y) { return 4ul * (static_cast<std::size_t>(y) * kWidth_px + x); };
  // Over black a premultiplied colour is itself.
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (i % 4 != 3) {
      ASSERT_EQ(bytes[i], over_black[0].pixels[i]) << "byte " << i;
    }
  }
  EXPECT_EQ(bytes[at(2, 2) + 3], 0);
  EXPECT_EQ(bytes[at(106, 60) + 3], 255);
  EXPECT_NEAR(bytes[at(66, 62) + 3], 128, 1);
  EXPECT_TRUE(test::is_ok(hosted.renderer->finish()));
}

TEST(RendererOnAHost, SaysWhatAHostAsksThatCannotBe) {
  RendererOptions options;
  options.cache_folder = "";
  TestHost old;
  old.allowed = {VulkanVersion{1, 0}, VulkanVersion{1, 0}};
  EXPECT_THAT(test::error_of(Renderer::create(options, old)), HasSubstr("Vulkan 1.0"));
  TestHost refusing;
  refusing.refusal = "the runtime has no device";
  const auto refused = Renderer::create(options, refusing);
  EXPECT_EQ(test::error_of(refused), "the runtime has no device");
  EXPECT_EQ(refused.error().code, ErrorCode::kUnavailable) << "as the host gave it";
  TestHost young;
  young.allowed = {VulkanVersion{1, 2}, VulkanVersion{1, 3}};
  EXPECT_TRUE(test::is_ok(Renderer::create(options, young)));
  EXPECT_EQ(young.asked_version, VK_API_VERSION_1_2);
}

TEST(RendererOnAHost, RefusesImagesThatDoNotFit) {
  Hosted hosted;
  TestImages images(hosted.renderer->objects(), VK_FORMAT_R8G8B8A8_SRGB, kWidth_px, kHeight_px, 1);
  EyeImages targets = images.targets();
  targets.chains.pop_back();
  EXPECT_THAT(test::error_of(hosted.renderer->use(targets)), HasSubstr("1 layers in 1 chains"));
  targets = images.targets();
  targets.format = VK_FORMAT_R32_UINT;
  EXPECT_THAT(test::error_of(hosted.renderer->use(targets)), HasSubstr("VkFormat"));
  targets = images.targets();
  targets.width_px = 1 << 20;
  EXPECT_THAT(test::error_of(hosted.renderer->use(targets)), HasSubstr("limit"));
  ASSERT_TRUE(test::is_ok(hosted.renderer->use(images.targets())));
  ASSERT_TRUE(test::is_ok(hosted.renderer->prepare({})));
  EXPECT_THAT(test::error_of(hosted.renderer->draw({}, eyes(), std::vector<std::uint32_t>{0, 2},
                                                   HeadTexts::kDrawn)),
              HasSubstr("image index out of range"));
  EXPECT_TRUE(test::is_ok(hosted.renderer->finish()));
}

}  // namespace
}  // namespace orthonav::render
