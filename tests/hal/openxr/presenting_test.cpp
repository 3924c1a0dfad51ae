#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/openxr/drawn_frames.h"
#include "tests/hal/openxr/golden_frames.h"
#include "tests/render/test_scenes.h"

namespace orthonav::test::presenting_test {
namespace {

using ::testing::HasSubstr;

TEST_F(RuntimeTest, DrawsEveryKindOfGoldenSceneAsItIs) {
  FrameComparison comparison(160, 120, render::Blend::kAdditive);
  std::size_t compared = 0;
  for (const char* name : {"digitizing", "verify", "h10_rod"}) {
    const engine::GoldenScene& scene = golden(name);
    open(head_of(scene));
    ASSERT_TRUE(present().ok());
    const std::size_t before = count_drawn();
    ASSERT_TRUE(show(scene.scene).ok());
    ASSERT_TRUE(eventually([&] { return count_drawn() >= before + 2; }));
    presenter_->stop();
    const auto pairs = matched(drawn(), runtime().frames());
    ASSERT_GE(pairs.size(), 2u);
    const auto difference = comparison.compare(pairs[0].first, pairs[0].second);
    EXPECT_EQ(difference.most, 0) << name;
    EXPECT_GT(difference.lit_px, 50u) << name;
    ++compared;
    presenter_.reset();
  }
  EXPECT_EQ(compared, 3u);
}

TEST_F(RuntimeTest, TellsHowFarThingsAreWhereTheRuntimeAsks) {
  RuntimeTraits traits;
  traits.takes_depth = true;
  traits.formats = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_D16_UNORM, VK_FORMAT_D32_SFLOAT};
  runtime().reset(traits);
  runtime().set_head([](XrTime) { return XrPosef{{0, 0, 0, 1}, {}}; });
  open();
  ASSERT_TRUE(present().ok());
  // A solid ball of 50 mm radius, a triangle far behind it.
  render::Scene scene =
      render::sphere_scene(render::MeshStyle::kSolid, {1, 1, 1, 1}, {0, 0, -1}, 301);
  scene.triangles.push_back({501, {render::Float3{-9, -9, -3}, {9, -9, -3}, {0, 0.5f, -3}}, {}});
  ASSERT_TRUE(show(scene).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 3; }));
  presenter_->stop();
  const auto pairs = matched(drawn(), runtime().frames());
  ASSERT_FALSE(pairs.empty());
  FrameComparison comparison(160, 120, render::Blend::kAdditive);
  EXPECT_EQ(comparison.compare(pairs[0].first, pairs[0].second).most, 0);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::vector<float>& depth_m = pairs[0].second.depth_m[eye];
    ASSERT_EQ(depth_m.size(), 160u * 120u);
    const float nearest = *std::min_element(depth_m.begin(), depth_m.end());
    EXPECT_NEAR(nearest, 0.95f, 0.005f) << "the ball's front";
    EXPECT_NEAR(depth_m[160 * 118 + 80], 3.0f, 0.01f) << "the triangle below";
    EXPECT_FALSE(depth_m[4] < 1e3f) << "nothing in the corner";
  }
}

/// A control that must fail: frames are not all alike.
TEST_F(RuntimeTest, TellsAFrameOfAnotherHeadPoseApart) {
  const engine::GoldenScene& scene = golden("guidance");
  open(head_of(scene));
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(scene.scene).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 20; }));
  presenter_->stop();
  FrameComparison comparison(160, 120, render::Blend::kAdditive);
  const auto pairs = matched(drawn(), runtime().frames());
  ASSERT_GE(pairs.size(), 20u);
  EXPECT_EQ(comparison.compare(pairs[0].first, pairs[0].second).most, 0);
  EXPECT_GT(comparison.compare(pairs[19].first, pairs[0].second).most, 10);
}

TEST_F(RuntimeTest, SubmitsNothingWhereNothingIsToBeRendered) {
  RuntimeTraits traits;
  traits.frames_without_render = 5;
  // At a display's pace: of a runtime that never waits there would be more frames than are kept.
  traits.stepped = false;
  traits.frames_kept = 100'000;
  runtime().reset(traits);
  open();
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(golden("guidance").scene).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 1; }));
  presenter_->stop();
  const auto frames = runtime().frames();
  ASSERT_GE(frames.size(), 6u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(frames[i].layers, 0u) << "frame " << i;
  }
  EXPECT_FALSE(frames[0].should_render);
}

/// Head-fixed holograms are drawn in the viewer's space, and say why there is nothing else.
TEST_F(RuntimeTest, DrawsTheStatusLineAloneWhileTheHeadIsNotLocated) {
  open();
  runtime().set_tracked(false, false);
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(golden("guidance").scene).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 10; }));
  for (const DrawnScene& frame : drawn()) {
    EXPECT_TRUE(hangs_on_head(frame.scene));
    ASSERT_FALSE(frame.scene.texts.empty());
    EXPECT_EQ(frame.scene.texts.back().runs[0].text,
              "Head not located: nothing is shown in the world");
  }
  runtime().set_tracked(true, true);
  EXPECT_TRUE(eventually([&] { return !hangs_on_head(drawn().back().scene); }));
  presenter_->stop();
  const auto pairs = matched(drawn(), runtime().frames());
  ASSERT_GE(pairs.size(), 2u);
  EXPECT_FALSE(pairs.front().second.on_head);
  const auto lost = std::find_if(pairs.begin(), pairs.end(),
                                 [](const auto& pair) { return pair.second.on_head; });
  ASSERT_NE(lost, pairs.end());
  EXPECT_FLOAT_EQ(lost->second.poses[0].position.x, -0.0315f);
  EXPECT_TRUE(hangs_on_head(lost->first.scene));
  FrameComparison comparison(160, 120, render::Blend::kAdditive);
  const auto difference = comparison.compare(lost->first, lost->second);
  EXPECT_EQ(difference.most, 0);
  EXPECT_EQ(difference.lit_px, 0u) << "the panel alone says it";
  EXPECT_GT(difference.lit_on_panel_px, 1000u);
}

TEST_F(RuntimeTest, HidesGuidanceThatGrewOldWhileTrackingStalls) {
  open();
  ASSERT_TRUE(present().ok());
  const engine::GoldenScene& scene = golden("guidance");
  ASSERT_FALSE(scene.scene.triangles.empty());
  engine::Snapshot snapshot;
  snapshot.scene = scene.scene;
  // The clock of the cameras stands; frames are shown three periods ahead of it.
  snapshot.expires = kStart + std::chrono::milliseconds(60);
  ASSERT_TRUE(presenter_->draw(snapshot).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 3; }));
  EXPECT_EQ(drawn().back().scene.triangles.size(), scene.scene.triangles.size());
  cameras_->manual_clock().advance(std::chrono::milliseconds(50));
  ASSERT_TRUE(eventually([&] { return drawn().back().scene.triangles.empty(); }));
  EXPECT_EQ(presenter_->stop().hidden, 1);
}

TEST_F(RuntimeTest, APresentingThreadThatHangsIsToldUntilItGoesOn) {
  open();
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(golden("guidance").scene).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() > 0; }));
  hold_ = true;
  ASSERT_TRUE(eventually([&] { return held_.load(); }));
  EXPECT_FALSE(presenter_->stalled());
  watch_.advance(engine::kStallAfter + Duration(1));
  EXPECT_TRUE(presenter_->stalled());
  hold_ = false;
  EXPECT_TRUE(eventually([&] { return !presenter_->stalled(); }));
}

TEST_F(RuntimeTest, TakesTheNewestSnapshot) {
  open();
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(golden("guidance").scene).ok());
  ASSERT_TRUE(show(golden("digitizing").scene).ok());
  // The first may have been drawn before the second came.
  EXPECT_TRUE(eventually([&] {
    return count_drawn() >= 1 &&
           drawn().back().scene.lines.size() == golden("digitizing").scene.lines.size();
  }));
}

TEST_F(RuntimeTest, TellsHowOldTheHeadsPoseIsWithEachFrame) {
  open();
  ASSERT_TRUE(present().ok());
  ASSERT_TRUE(show(golden("guidance").scene).ok());
  ASSERT_TRUE(eventually([&] { return count_drawn() >= 10; }));
  const engine::PresentReport report = presenter_->stop();
  ASSERT_EQ(report.latch_ms.count(), report.drawn);
  EXPECT_GT(report.latch_ms.quantile(0.0).value_or(0.0), 0.0);
}

std::string refusal(RuntimeTraits traits, Headset& headset) {
  runtime_double().reset(traits);
  const auto presenter = engine::Presenter::start(*headset.pixels(), {});
  return presenter.ok() ? "presented" : presenter.error().message;
}

TEST_F(RuntimeTest, SaysInOneLineWhatIsMissing) {
  Headset& headset = open();
  EXPECT_THAT(refusal(with([](RuntimeTraits& t) { t.headset = false; }), headset),
              HasSubstr("no headset at the moment"));
  open();
  EXPECT_THAT(refusal(with([](RuntimeTraits& t) { t.converts_time = false; }), *headset_),
              HasSubstr("XR_KHR_convert_timespec_time"));
  // The loader remembers what the runtime offered until it has unloaded it.
  runtime().reset({});
  static_cast<void>(openxr::describe_runtime());
  open();
  EXPECT_THAT(refusal(with([](RuntimeTraits& t) { t.formats = {126}; }), *headset_),
              HasSubstr("none of the image formats"));
  open();
  EXPECT_THAT(
      refusal(with([](RuntimeTraits& t) { t.most_vulkan = XR_MAKE_VERSION(1, 0, 0); }), *headset_),
      HasSubstr("Vulkan 1.0"));
  open();
  EXPECT_THAT(refusal(with([](RuntimeTraits& t) { t.blends = {}; }), *headset_),
              HasSubstr("no known way to meet the world"));
}

TEST_F(RuntimeTest, IsDescribedByRuntimeAndHeadset) {
  const auto described = openxr::describe_runtime();
  ASSERT_TRUE(described.ok()) << described.error().message;
  EXPECT_EQ(*described, "orthonav's double 0.1.0, scripted headset");
}

}  // namespace
}  // namespace orthonav::test::presenting_test
