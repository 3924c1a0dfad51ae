#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/hal/openxr/drawn_frames.h"
#include "tests/hal/openxr/golden_frames.h"

namespace orthonav::test::presenting_test {
namespace {

/// A runtime that differs from the usual one.
struct Variant {
  const char* name;
  RuntimeTraits traits;
  render::Blend blend = render::Blend::kAdditive;
  XrEnvironmentBlendMode mode = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
  int tolerance = 0;
  std::size_t beyond = 0;  ///< colour values that may differ by more
  bool head_still = false;
};
void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

RuntimeTraits srgb(const std::function<void(RuntimeTraits&)>& change) {
  return with([&](RuntimeTraits& t) {
    t.formats = {VK_FORMAT_R8G8B8A8_SRGB};
    change(t);
  });
}

Variant linear() {
  Variant variant{"linear", with([](RuntimeTraits& t) { t.formats = {126, 37}; })};
  // Eight bits of linear light: both images round at each of a few blends, sRGB's steps in the
  // light being up to 2.2 of 255.
  variant.tolerance = 5;
  // Where a surface's edge passes through a pixel's centre, shaders/edge.frag decides by the
  // colours around it on which side the pixel lies. Colours that are rounded otherwise may decide
  // otherwise, and the pixel is another one: one of a view's pixels, or none. More of them in a few
  // of the views that a swaying head has.
  variant.head_still = true;
  variant.beyond = 3;
  return variant;
}

/// A display that does not add its light to the world: over black, both blends give the same.
Variant covering(const char* name, const std::vector<XrEnvironmentBlendMode>& blends) {
  Variant variant{name, srgb([&](RuntimeTraits& t) { t.blends = blends; })};
  variant.mode = blends.back();
  variant.blend = render::Blend::kOver;
  return variant;
}

/// The last format of each list is the one to be taken, and so is the last blend.
std::vector<Variant> runtimes() {
  const std::vector<XrReferenceSpaceType> plain = {XR_REFERENCE_SPACE_TYPE_VIEW,
                                                   XR_REFERENCE_SPACE_TYPE_LOCAL};
  return {
      {"usual", with([](RuntimeTraits& t) {
         t.formats = {37, 50, 43};
       })},
      {"swapped", with([](RuntimeTraits& t) {
         t.formats = {44, 126, 50};
       })},
      {"one_layer", srgb([](RuntimeTraits& t) { t.most_layers = 1; })},
      {"local_only", srgb([&](RuntimeTraits& t) { t.spaces = plain; })},
      {"no_controller", srgb([](RuntimeTraits& t) { t.controller = false; })},
      {"untracked_position", srgb([](RuntimeTraits& t) { t.position_tracked = false; })},
      {"turns_only", srgb([](RuntimeTraits& t) { t.position_known = false; })},
      {"young_vulkan", srgb([](RuntimeTraits& t) { t.least_vulkan = XR_MAKE_VERSION(1, 2, 0); })},
      linear(),
      covering("opaque", {XR_ENVIRONMENT_BLEND_MODE_OPAQUE}),
      covering("alpha", {XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND})};
}

class EveryRuntime : public RuntimeTest, public ::testing::WithParamInterface<Variant> {};

TEST_P(EveryRuntime, GetsTheFramesThatTheRendererDraws) {
  const Variant& variant = GetParam();
  runtime().reset(variant.traits);
  if (variant.head_still) {
    runtime().set_head([](XrTime) { return XrPosef{{0, 0, 0, 1}, {0, 0, 0}}; });
  }
  const engine::GoldenScene& scene = golden("guidance");
  open(head_of(scene));
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(scene.scene).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 4; }));
  presenter_->stop();
  // A compositor that reads alpha gets four samples.
  const bool reads_alpha = variant.mode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
  FrameComparison comparison(static_cast<int>(variant.traits.width_px),
                             static_cast<int>(variant.traits.height_px), variant.blend,
                             reads_alpha ? render::Edges::kSamples : render::Edges::kCoverage);
  const auto pairs = matched(drawn(), runtime().frames());
  ASSERT_GE(pairs.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto difference = comparison.compare(pairs[i].first, pairs[i].second, variant.tolerance);
    EXPECT_LE(difference.beyond, variant.beyond) << "the largest difference: " << difference.most;
    EXPECT_GT(difference.lit_px, 100u) << "nothing was there to be compared";
    EXPECT_EQ(pairs[i].second.blend, variant.mode);
    EXPECT_EQ(pairs[i].second.format, variant.traits.formats.back());
  }
}

INSTANTIATE_TEST_SUITE_P(Runtimes, EveryRuntime, ::testing::ValuesIn(runtimes()),
                         [](const auto& variant) { return std::string(variant.param.name); });

}  // namespace
}  // namespace orthonav::test::presenting_test
