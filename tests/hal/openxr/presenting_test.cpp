#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/golden/golden_scenes.h"
#include "tests/hal/openxr/drawn_frames.h"
#include "tests/render/test_scenes.h"

namespace orthonav::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Of the golden scene of that name.
const engine::GoldenScene& golden(const std::string& name) {
  static const std::vector<engine::GoldenScene> kScenes = engine::golden_scenes();
  for (const engine::GoldenScene& scene : kScenes) {
    if (scene.name == name) {
      return scene;
    }
  }
  ADD_FAILURE() << "no golden scene " << name;
  return kScenes.front();
}

/// The head pose that sees a golden scene as in its picture.
Transform<World, Rig> head_of(const engine::GoldenScene& scene) {
  std::array<double, 16> rows{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      rows[4 * r + c] = static_cast<double>(scene.views.front().eye_from_world[4 * c + r]);
    }
  }
  const auto eye_from_world = Transform<Rig, World>::from_row_major(rows);
  EXPECT_TRUE(eye_from_world.ok());
  return eye_from_world->inverse();
}

/// A runtime that differs from the usual one.
struct Variant {
  const char* name;
  RuntimeTraits traits;
  render::Blend blend = render::Blend::kAdditive;
  XrEnvironmentBlendMode mode = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
  int tolerance = 0;
  bool head_still = false;
};
void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

RuntimeTraits with(const std::function<void(RuntimeTraits&)>& change) {
  RuntimeTraits traits;
  change(traits);
  return traits;
}

/// The last format of each list is the one to be taken.
std::vector<Variant> runtimes() {
  const std::vector<XrReferenceSpaceType> plain = {XR_REFERENCE_SPACE_TYPE_VIEW,
                                                   XR_REFERENCE_SPACE_TYPE_LOCAL};
  const auto srgb = [](const std::function<void(RuntimeTraits&)>& change) {
    RuntimeTraits traits;
    traits.formats = {VK_FORMAT_R8G8B8A8_SRGB};
    change(traits);
    return traits;
  };
  std::vector<Variant> all = {
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
      {"young_vulkan", srgb([](RuntimeTraits& t) { t.least_vulkan = XR_MAKE_VERSION(1, 2, 0); })}};
  // Eight bits of linear light: both images round at each of a few blends, sRGB's steps in the
  // light being up to 2.2 of 255.
  all.push_back({"linear", with([](RuntimeTraits& t) { t.formats = {126, 37}; })});
  all.back().tolerance = 5;
  // Where a surface's edge passes through a pixel's centre, shaders/edge.frag decides by the
  // colours around it on which side the pixel lies. Colours that are rounded otherwise may decide
  // otherwise, and the pixel is another one, in a few of the views that a swaying head has.
  all.back().head_still = true;
  all.push_back(
      {"opaque", srgb([](RuntimeTraits& t) { t.blends = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE}; })});
  all.back().mode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  all.push_back(
      {"alpha", srgb([](RuntimeTraits& t) {
         t.blends = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND};
       })});
  all.back().mode = XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
  // Both blends give the same over black.
  for (auto variant = all.end() - 2; variant != all.end(); ++variant) {
    variant->blend = render::Blend::kOver;
  }
  return all;
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
    const auto difference = comparison.compare(pairs[i].first, pairs[i].second);
    EXPECT_LE(difference.most, variant.tolerance);
    EXPECT_GT(difference.lit_px, 100u) << "nothing was there to be compared";
    EXPECT_EQ(pairs[i].second.blend, variant.mode);
    EXPECT_EQ(pairs[i].second.format, variant.traits.formats.back());
  }
}

INSTANTIATE_TEST_SUITE_P(Runtimes, EveryRuntime, ::testing::ValuesIn(runtimes()),
                         [](const auto& variant) { return std::string(variant.param.name); });

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
  ASSERT_EQ(report.latch_ms.size(), static_cast<std::size_t>(report.drawn));
  for (const double latch_ms : report.latch_ms) {
    EXPECT_GT(latch_ms, 0.0);
  }
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
}  // namespace orthonav::test
