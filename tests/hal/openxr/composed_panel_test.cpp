// What the wearer sees of a panel over the eyes' images.
#include <gtest/gtest.h>

#include "tests/hal/openxr/composed.h"
#include "tests/hal/openxr/drawn_frames.h"
#include "tests/hal/openxr/software_renderer.h"
#include "tests/hal/openxr/status_scene.h"

namespace orthonav::test::composed_panel_test {
namespace {

struct Look {
  const char* name;
  XrEnvironmentBlendMode mode;
  render::Blend blend;
};
void PrintTo(const Look& look, std::ostream* out) { *out << look.name; }

constexpr int kWide_px = 1440;
constexpr int kHigh_px = 1188;

class ComposedPanel : public RuntimeTest, public ::testing::WithParamInterface<Look> {
 protected:
  /// Presents a scene on a display of that look until a frame of it was submitted.
  void present_scene(const Look& look, const render::Scene& scene) {
    RuntimeTraits traits;
    traits.width_px = kWide_px;
    traits.height_px = kHigh_px;
    traits.blends = {look.mode};
    traits.frames_kept = 2;
    runtime().reset(traits);
    open();
    ASSERT_TRUE(present().ok());
    ASSERT_TRUE(show(scene).ok());
    ASSERT_TRUE(eventually([&] { return count_drawn() >= 3; }));
    presenter_->stop();
  }
};

std::vector<double> light_of(const RgbaImage& image) {
  std::vector<double> light;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i % 4 != 3) {
      light.push_back(linear_from_srgb(image.pixels[i] / 255.0));
    }
  }
  return light;
}

/// How a composed picture differs from the one in which the eyes' images show the status line.
struct Apart {
  double most_beside = 0;  ///< levels of 255, where the panel lights nothing
  double rms = 0;          ///< levels of 255, of values that the status line lights
  double right_px = 0;     ///< how far it is shifted, by least squares
  double down_px = 0;
  double light = 0;  ///< relative
};

Apart apart(const std::vector<double>& composed, const std::vector<double>& expected,
            const std::vector<double>& bare) {
  Apart result;
  double squares = 0;
  double got = 0;
  double wanted = 0;
  std::size_t lit = 0;
  double xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  constexpr std::size_t kRow = 3ul * kWide_px;
  for (std::size_t i = kRow; i + kRow < composed.size(); ++i) {
    const double light = composed[i] - expected[i];
    const double levels = 255.0 * (srgb_from_linear(composed[i]) - srgb_from_linear(expected[i]));
    got += composed[i] - bare[i];
    wanted += expected[i] - bare[i];
    if (expected[i] != bare[i]) {
      squares += levels * levels;
      ++lit;
    } else if (composed[i] == bare[i]) {
      result.most_beside = std::max(result.most_beside, std::abs(levels));
    }
    const double x = 0.5 * (expected[i + 3] - expected[i - 3]);
    const double y = 0.5 * (expected[i + kRow] - expected[i - kRow]);
    xx += x * x, xy += x * y, yy += y * y;
    xd -= x * light, yd -= y * light;
  }
  const double determinant = xx * yy - xy * xy;
  result.right_px = (yy * xd - xy * yd) / determinant;
  result.down_px = (xx * yd - xy * xd) / determinant;
  result.rms = std::sqrt(squares / static_cast<double>(lit));
  result.light = got / wanted - 1.0;
  return result;
}

TEST_P(ComposedPanel, LooksAsInTheEyesImages) {
  const Look& look = GetParam();
  // The triangle lies behind the status line too: what is below the panel shows.
  render::Scene scene = scene_that_says("digitize L4");
  scene.triangles.front().corners = {{{-0.3f, -0.4f, -1}, {0.3f, -0.4f, -1}, {0, 0.2f, -1}}};
  scene.triangles.front().colour = {0.1f, 0.3f, 0.1f, 1};
  ASSERT_NO_FATAL_FAILURE(present_scene(look, scene));
  const auto pairs = matched(drawn(), runtime().frames());
  ASSERT_FALSE(pairs.empty());
  const auto& [shown, frame] = pairs.front();
  ASSERT_TRUE(frame.quad.has_value());
  const bool reads_alpha = look.mode == XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
  const auto renderer =
      software_renderer(kWide_px, kHigh_px, look.blend,
                        reads_alpha ? render::Edges::kSamples : render::Edges::kCoverage);
  std::vector<RgbaImage> with;
  std::vector<RgbaImage> without;
  ASSERT_TRUE(is_ok(renderer->draw(shown.scene, shown.views, {}, with)));
  scene.texts.clear();
  ASSERT_TRUE(is_ok(renderer->draw(scene, shown.views, {}, without)));
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::vector<double> expected = light_of(with[eye]);
    const std::vector<double> bare = light_of(without[eye]);
    const Apart off = apart(Composed(frame, kWide_px, kHigh_px).eye(eye), expected, bare);
    std::printf("%s eye %zu: rms %.2f, right %.4f px, down %.4f px, light %.4f\n", look.name, eye,
                off.rms, off.right_px, off.down_px, off.light);
    EXPECT_EQ(off.most_beside, 0.0);
    // The compositor samples the panel once more: edges of glyphs and of their dark halo are
    // softer, and nothing else.
    EXPECT_LT(off.rms, 16.0);
    EXPECT_LT(std::abs(off.light), 0.02);
    EXPECT_LT(std::hypot(off.right_px, off.down_px), 0.05);
    // A panel that hangs a pixel beside its place is found out.
    SubmittedFrame aside = frame;
    aside.quad->pose.position.x += 0.509f * 0.969f / kWide_px;
    const Apart far = apart(Composed(aside, kWide_px, kHigh_px).eye(eye), expected, bare);
    EXPECT_GT(std::abs(far.right_px), 0.3);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Displays, ComposedPanel,
    ::testing::Values(Look{"additive", XR_ENVIRONMENT_BLEND_MODE_ADDITIVE,
                           render::Blend::kAdditive},
                      Look{"alpha", XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND, render::Blend::kOver},
                      Look{"opaque", XR_ENVIRONMENT_BLEND_MODE_OPAQUE, render::Blend::kOver}),
    [](const auto& look) { return std::string(look.param.name); });

}  // namespace
}  // namespace orthonav::test::composed_panel_test
