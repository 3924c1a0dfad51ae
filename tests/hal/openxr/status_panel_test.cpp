// The status line on a layer of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/holograms/labels/panel_layout.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "tests/hal/openxr/drawn_frames.h"
#include "tests/hal/openxr/software_renderer.h"
#include "tests/hal/openxr/status_scene.h"

namespace orthonav::test::status_panel_test {
namespace {

using ::testing::IsEmpty;

/// What the panel's image should look like.
std::vector<std::uint8_t> panel_that_says(const render::Scene& scene) {
  static const std::unique_ptr<render::Renderer> kRenderer =
      software_renderer(engine::kStatusPanel_px[0], engine::kStatusPanel_px[1],
                        render::Blend::kAdditive, render::Edges::kHard);
  render::Scene panel;
  EXPECT_TRUE(engine::PanelLayout::write(scene, panel));
  std::vector<RgbaImage> images;
  EXPECT_TRUE(is_ok(kRenderer->draw(panel, {engine::status_panel_view()}, {}, images)));
  return images.front().pixels;
}

/// Whether a panel shows the status line of `scene`; its alpha is ignored.
bool shows(const SubmittedQuad& quad, const render::Scene& scene) {
  const std::vector<std::uint8_t> expected = panel_that_says(scene);
  if (!quad.pixels || quad.pixels->size() != expected.size()) {
    return false;
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (i % 4 != 3 && (*quad.pixels)[i] != expected[i]) {
      return false;
    }
  }
  return true;
}

class StatusPanelTest : public RuntimeTest {
 protected:
  void begin(const RuntimeTraits& traits = {}) {
    runtime().reset(traits);
    open();
    ASSERT_TRUE(present().ok());
  }
  /// Shows a step, and returns once it has been drawn a few times.
  void say(const std::string& step) {
    static_cast<void>(show(scene_that_says(step)));  // an Error is that of an earlier frame
    const std::size_t before = count_drawn();
    ASSERT_TRUE(eventually([&] { return count_drawn() >= before + 5; }));
  }
  /// Every frame must show the status line once, on the panel or in the eyes' images, and the rest
  /// of the scene unchanged. Returns how many frames had a panel.
  static std::size_t check_all(const std::vector<DrawnScene>& drawn,
                               const std::vector<SubmittedFrame>& frames) {
    FrameComparison comparison(160, 120, render::Blend::kAdditive);
    std::size_t with_panel = 0;
    const auto pairs = matched(drawn, frames);
    EXPECT_THAT(pairs, Not(IsEmpty()));
    for (const auto& [scene, frame] : pairs) {
      EXPECT_EQ(comparison.compare(scene, frame).most, 0) << "frame " << frame.number;
      if (frame.quad) {
        EXPECT_TRUE(shows(*frame.quad, scene.scene)) << "frame " << frame.number;
        ++with_panel;
      }
    }
    return with_panel;
  }
  std::size_t check_all() {
    presenter_->stop();
    return check_all(drawn(), runtime().frames());
  }
};

TEST_F(StatusPanelTest, HangsOnTheHeadWhereTheEyesImagesWouldShowIt) {
  begin();
  say("digitize L4");
  presenter_->stop();
  const auto frames = runtime().frames();
  const auto frame = std::find_if(frames.rbegin(), frames.rend(),
                                  [](const auto& one) { return one.quad.has_value(); });
  ASSERT_NE(frame, frames.rend());
  EXPECT_EQ(frame->layers, 2u);
  const SubmittedQuad& quad = *frame->quad;
  EXPECT_TRUE(quad.on_head);
  EXPECT_FALSE(frame->on_head) << "what is in the world stays there";
  EXPECT_FLOAT_EQ(quad.pose.position.y, -0.096f);
  EXPECT_FLOAT_EQ(quad.pose.position.z, -0.5f);
  EXPECT_NEAR(quad.pose.orientation.x, -std::sin(0.5 * std::atan(0.096 / 0.5)), 1e-6);
  // Capitals of half a degree, 16 pixels each, at 0.509 m.
  EXPECT_NEAR(quad.size.width, 1152 / 16.0 * 0.004443, 1e-4);
  EXPECT_NEAR(quad.size.height, 176 / 16.0 * 0.004443, 1e-4);
  EXPECT_EQ(quad.flags, XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT)
      << "premultiplied, and nothing of the layer below is hidden where nothing is written";
}

TEST_F(StatusPanelTest, IsDrawnOnlyWhenItSaysSomethingElse) {
  begin();
  say("digitize L4");
  say("digitize L4");
  say("verify L4");
  ASSERT_TRUE(frames_pass(10));
  EXPECT_GT(check_all(), 10u);
  EXPECT_EQ(runtime().frames().back().should_render, true);
  std::int64_t releases = 0;
  for (const SubmittedFrame& frame : runtime().frames()) {
    releases = std::max(releases, frame.quad ? frame.quad->releases : 0);
  }
  EXPECT_EQ(releases, 2);
}

TEST_F(StatusPanelTest, IsInTheEyesImagesWhereTheRuntimeTakesOneLayer) {
  RuntimeTraits traits;
  traits.most_composition_layers = 1;
  begin(traits);
  say("digitize L4");
  EXPECT_EQ(check_all(), 0u);
}

TEST_F(StatusPanelTest, IsInTheEyesImagesWhereTheRuntimeMakesNoImagesForIt) {
  for (const char* call : {"xrCreateSwapchain", "xrEnumerateSwapchainImages"}) {
    runtime().reset({});
    runtime().fail_of_panel(call, XR_ERROR_RUNTIME_FAILURE, 1);
    open();
    ASSERT_TRUE(present().ok());
    say("digitize L4");
    EXPECT_EQ(check_all(), 0u) << call;
    presenter_.reset();
  }
}

/// A call that fails a few times while the text changes.
struct Failure {
  const char* call;
  XrResult result;
  int times;
  bool for_good;  ///< the session has no panel from then on
};
void PrintTo(const Failure& failure, std::ostream* out) { *out << failure.call; }

class FailingPanel : public StatusPanelTest, public ::testing::WithParamInterface<Failure> {};

TEST_P(FailingPanel, LeavesTheStatusLineInTheEyesImages) {
  const Failure& failure = GetParam();
  begin();
  say("digitize L4");
  runtime().fail_of_panel(failure.call, failure.result, failure.times);
  say("verify L4");
  say("guide L4 left");
  presenter_->stop();
  // The double keeps nothing of a frame that it refuses: it can't be compared.
  std::vector<DrawnScene> all = drawn();
  if (std::string(failure.call) == "xrEndFrame") {
    const auto first = std::find_if(all.begin(), all.end(), [](const DrawnScene& one) {
      return one.scene.texts.front().runs[0].text.starts_with("verify");
    });
    all.erase(all.begin(), first + 1);
  }
  const std::size_t with_panel = check_all(all, runtime().frames());
  const auto last = runtime().frames().back();
  EXPECT_EQ(last.quad.has_value(), !failure.for_good);
  if (!failure.for_good) {
    EXPECT_GT(with_panel, 5u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Calls, FailingPanel,
    ::testing::Values(Failure{"xrAcquireSwapchainImage", XR_ERROR_RUNTIME_FAILURE, 2, false},
                      Failure{"xrWaitSwapchainImage", XR_TIMEOUT_EXPIRED, 3, false},
                      Failure{"xrWaitSwapchainImage", XR_ERROR_RUNTIME_FAILURE, 1, false},
                      Failure{"xrReleaseSwapchainImage", XR_ERROR_RUNTIME_FAILURE, 1, true},
                      Failure{"xrEndFrame", XR_ERROR_LAYER_LIMIT_EXCEEDED, 1, true}),
    [](const auto& failure) {
      return std::string(failure.param.call) + std::to_string(failure.index);
    });

TEST_F(StatusPanelTest, ASessionLostWhileItsImageIsHeldIsMadeAnewWithAPanel) {
  begin();
  say("digitize L4");
  // The image is acquired but never becomes free.
  runtime().fail_of_panel("xrWaitSwapchainImage", XR_TIMEOUT_EXPIRED, 1'000'000);
  say("verify L4");
  EXPECT_FALSE(runtime().frames().back().quad.has_value());
  runtime().lose_session(true);
  ASSERT_TRUE(eventually([&] { return runtime().sessions() == 2; }));
  runtime().fail_of_panel("", XR_SUCCESS, 0);
  say("guide L4 left");
  ASSERT_TRUE(frames_pass(3));
  EXPECT_TRUE(runtime().frames().back().quad.has_value());
  EXPECT_GT(check_all(), 0u);
}

TEST_F(StatusPanelTest, SaysThatTheHeadIsLostEvenWhereTheEyesAreUnknown) {
  RuntimeTraits traits;
  traits.eyes_on_head = false;
  begin(traits);
  say("digitize L4");
  runtime().set_tracked(false, false);
  const std::int64_t from = runtime().ended_frames() + 2;
  ASSERT_TRUE(eventually([&] { return runtime().ended_frames() > from + 5; }));
  presenter_->stop();
  render::Scene lost;
  engine::write_head_lost(scene_that_says("digitize L4"), lost);
  std::size_t checked = 0;
  for (const SubmittedFrame& frame : runtime().frames()) {
    if (frame.number <= from || !frame.should_render || frame.layers == 0) {
      continue;
    }
    EXPECT_FALSE(frame.has_eyes);
    ASSERT_TRUE(frame.quad.has_value());
    EXPECT_TRUE(shows(*frame.quad, lost));
    ++checked;
  }
  EXPECT_GT(checked, 3u);
}

}  // namespace
}  // namespace orthonav::test::status_panel_test
