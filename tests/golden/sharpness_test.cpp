#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "engine/golden/golden_scenes.h"
#include "tests/support/is_ok.h"
#include "tests/support/many_samples.h"
#include "tests/support/test_device.h"

namespace orthonav::engine {
namespace {

using render::Edges;

std::vector<RgbaImage> drawn(const GoldenScene& scene, Edges edges) {
  render::RendererOptions options;
  options.width_px = scene.width_px;
  options.height_px = scene.height_px;
  options.edges = edges;
  options.device = test::test_device();
  std::vector<RgbaImage> images;
  const auto renderer = render::Renderer::create(options);
  EXPECT_TRUE(test::is_ok(renderer));
  EXPECT_TRUE(test::is_ok((*renderer)->draw(scene.scene, scene.views, {}, images)));
  return images;
}

class Sharpness : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Sharpness,
                         ::testing::Values("guidance", "h1_saved", "h2_vertebra", "h5_red",
                                           "h10_rod"));

/// docs/lab/rendering.md has the errors of every scene; texts are drawn alike.
TEST_P(Sharpness, IsGreaterWithComputedCoverageThanWithFourSamples) {
  const std::vector<GoldenScene> scenes = golden_scenes();
  GoldenScene scene = *std::find_if(scenes.begin(), scenes.end(),
                                    [](const auto& each) { return each.name == GetParam(); });
  scene.scene.texts.clear();
  render::RendererOptions options;
  options.width_px = scene.width_px;
  options.height_px = scene.height_px;
  options.edges = Edges::kHard;
  options.device = test::test_device();
  const auto hard = render::Renderer::create(options);
  ASSERT_TRUE(test::is_ok(hard));
  const auto reference = render::many_samples(**hard, scene.scene, scene.views, 8);
  ASSERT_TRUE(test::is_ok(reference));
  const std::vector<RgbaImage> one = drawn(scene, Edges::kHard);
  const std::vector<RgbaImage> four = drawn(scene, Edges::kSamples);
  const std::vector<RgbaImage> coverage = drawn(scene, Edges::kCoverage);
  render::EdgeError of_one, of_four, of_coverage;
  for (std::size_t view = 0; view < one.size(); ++view) {
    render::add_error((*reference)[view], one[view], one[view], of_one);
    render::add_error((*reference)[view], one[view], four[view], of_four);
    render::add_error((*reference)[view], one[view], coverage[view], of_coverage);
  }
  EXPECT_GT(of_coverage.channels, 300u);
  EXPECT_LT(of_coverage.rms(), 0.8 * of_four.rms());
  EXPECT_GT(of_one.rms(), of_four.rms()) << "the twin";
}

}  // namespace
}  // namespace orthonav::engine
