#include "tools/preview/model.h"
#include "engine/holograms/shapes/hologram_label.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/tools/preview/model_bench.h"
#include "tools/preview/error_sources.h"

namespace orthonav::preview::model_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A model that moments can be passed to.
struct Bench : ModelBench {
  void pass(int pairs) {
    for (int i = 0; i < pairs && gate.may_pass(); ++i) {
      gate.pass(Timestamp(Duration(33'000'000 * (gate.passed() + 1))));
      auto moment = std::make_shared<Moment>();
      moment->pair = gate.passed();
      timeline.push(moment);
    }
  }
  void tap(char c) {
    model.key(key_of(c), true);
    model.key(key_of(c), false);
  }
  std::int64_t shown() const { return model.shown() ? model.shown()->pair : 0; }
  std::vector<std::string> said() {
    std::vector<std::string> phrases;
    keyboard.take_phrases(phrases);
    return phrases;
  }
};

TEST(PreviewModel, SaysWhatTheKeysStandFor) {
  Bench bench;
  for (const char c : {'s', 'v', 'd', 'a', 'r', 'n', 'f', 'm', 't'}) {
    bench.tap(c);
  }
  EXPECT_THAT(bench.said(), ElementsAre("start", "save", "delete", "accept", "reject", "next",
                                        "done", "move rod", "twin"));
  bench.tap(';');
  EXPECT_THAT(bench.said(), IsEmpty());
}

TEST(PreviewModel, TellsTheClickerOfChangesOnly) {
  Bench bench;
  for (const bool down : {true, true, false, false, true}) {
    bench.model.key(Key::kSpace, down);
  }
  std::vector<bool> downs;
  bench.keyboard.take_button(downs);
  EXPECT_THAT(downs, ElementsAre(true, false, true));
}

TEST(PreviewModel, PausesAndSteps) {
  Bench bench;
  bench.gate.set_speed(0.0);
  bench.pass(10);
  bench.tap('p');
  bench.pass(10);
  EXPECT_EQ(bench.shown(), 10);
  bench.model.key(Key::kRight, true);
  bench.pass(10);
  EXPECT_EQ(bench.shown(), 11);
  bench.tap('p');
  bench.pass(10);
  EXPECT_EQ(bench.shown(), 21);
}

TEST(PreviewModel, LooksBackAndComesBack) {
  Bench bench;
  bench.gate.set_speed(0.0);
  bench.pass(10);
  bench.model.key(Key::kLeft, true);
  bench.model.key(Key::kLeft, true);
  EXPECT_EQ(bench.shown(), 8);
  EXPECT_TRUE(bench.gate.paused());
  bench.model.key(Key::kRight, true);
  EXPECT_EQ(bench.shown(), 9);
  bench.pass(10);  // Looking at the past is not a step of the operation.
  EXPECT_EQ(bench.gate.passed(), 10);
  bench.model.key(Key::kRight, true);
  EXPECT_FALSE(bench.model.looks_back());
  bench.model.scrub_to(3);
  EXPECT_EQ(bench.shown(), 3);
  // The newest moment also stays while it is looked at.
  bench.model.scrub_to(10);
  EXPECT_FALSE(bench.model.looks_back());
  bench.gate.step();
  bench.pass(10);
  EXPECT_EQ(bench.shown(), 10);
  bench.tap('l');
  EXPECT_EQ(bench.shown(), 11);
}

TEST(PreviewModel, ScrubsToWhatIsToCome) {
  Bench bench;
  bench.pass(2);
  bench.model.scrub_to(40);
  bench.pass(1000);
  EXPECT_EQ(bench.shown(), 40);
  EXPECT_EQ(bench.gate.passed(), 40);
}

TEST(PreviewModel, ChangesSpeedBetweenItsEnds) {
  Bench bench;
  for (int i = 0; i < 10; ++i) {
    bench.tap('=');
  }
  EXPECT_EQ(bench.gate.speed(), 0.0);
  bench.tap('-');
  EXPECT_EQ(bench.gate.speed(), 4.0);
  for (int i = 0; i < 10; ++i) {
    bench.tap('-');
  }
  EXPECT_EQ(bench.gate.speed(), 0.1);
}

TEST(PreviewModel, HandsWishesOutOnce) {
  Bench bench;
  for (const char c : {'i', 'k', 'q'}) {
    bench.tap(c);
  }
  const Wishes wishes = bench.model.take_wishes();
  EXPECT_TRUE(wishes.screenshot && wishes.video && wishes.quit && !wishes.restart);
  EXPECT_FALSE(bench.model.take_wishes().quit);
}

TEST(Keys, AreEachBoundOnceAndFoundByName) {
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_EQ(binding_of(binding.key), &binding) << binding.name;
    EXPECT_EQ(key_named(binding.name), binding.key) << binding.name;
  }
  EXPECT_FALSE(key_named("hyper").has_value());
}

/// One item of each kind for each of the holograms.
render::Scene full_scene() {
  render::Scene scene;
  for (unsigned n = 1; n <= kLastHologram; ++n) {
    scene.meshes.emplace_back().label = 100 * n + 1;
    scene.lines.emplace_back().label = 100 * n + 2;
    scene.triangles.emplace_back().label = 100 * n + 3;
    scene.texts.emplace_back().label = 100 * n + 4;
  }
  return scene;
}

TEST(HologramFilter, TakesOutWhatIsHiddenAndNothingElse) {
  const render::Scene scene = full_scene();
  for (unsigned hidden = 1; hidden <= kLastHologram; ++hidden) {
    HologramFilter filter;
    filter.show(hidden, false);
    render::Scene seen;
    filter.apply(scene, seen);
    ASSERT_EQ(seen.lines.size(), kLastHologram - 1) << hidden;
    EXPECT_EQ(seen.meshes.size() + seen.triangles.size() + seen.texts.size(),
              3 * (kLastHologram - 1));
    for (const auto& line : seen.lines) {
      EXPECT_NE(static_cast<unsigned>(engine::kind_of(line.label)), hidden);
    }
  }
}

TEST(HologramFilter, TogglesAllToNoneOnlyFromAll) {
  HologramFilter filter;
  filter.toggle(5);
  filter.toggle_all();
  EXPECT_TRUE(filter.shows(5) && filter.shows(1));
  filter.toggle_all();
  EXPECT_FALSE(filter.shows(5) || filter.shows(1));
}

TEST(Timeline, CoversTheWholeTimeInABoundedSpace) {
  Timeline timeline(64);
  const auto kept = [&] {
    int moments = 1;
    for (auto at = timeline.at(1); at != timeline.newest(); at = timeline.after(at->pair)) {
      ++moments;
    }
    return moments;
  };
  for (int i = 1; i <= 10000; ++i) {
    auto moment = std::make_shared<Moment>();
    moment->pair = i;
    timeline.push(moment);
    ASSERT_LE(kept(), 64);
  }
  EXPECT_EQ(timeline.newest()->pair, 10000);
  EXPECT_EQ(timeline.at(1)->pair, 1);
  EXPECT_EQ(timeline.at(-5)->pair, 1);
  // There is no large gap anywhere.
  for (int i = 1; i <= 10000; i += 100) {
    EXPECT_LE(std::abs(timeline.at(i)->pair - i), 640) << i;
  }
  EXPECT_EQ(timeline.before(1)->pair, 1);
  EXPECT_EQ(timeline.after(10000)->pair, 10000);
}

TEST(Camera, BeginsToOrbitWhereTheEyeIs) {
  const Transform<sim::Room, Eye> eye{
      rotation_from_vector({0.0, 0.4, 0.0}) * rotation_from_vector({-0.8, 0.0, 0.0}),
      {0.1, 0.5, 0.2}};
  Camera camera;
  camera.start_orbit(eye);
  EXPECT_LT((camera.stage_from_eye().translation() - eye.translation()).norm(), 1e-9);
  EXPECT_LT(rotation_angle_rad(camera.stage_from_eye().rotation(), eye.rotation()), 1e-6);
}

TEST(Camera, GoesRoundWhatItLooksAt) {
  Camera camera;
  camera.start_orbit({rotation_from_vector({-0.8, 0.0, 0.0}), {0.0, 0.4, 0.3}});
  const auto focus = [&camera] { return camera.stage_from_eye() * Point<Eye>{{0.0, 0.0, -0.45}}; };
  const Vec3 before = focus().v;
  for (int i = 0; i < 50; ++i) {
    camera.orbit({0.07, 0.05});
  }
  EXPECT_LT((focus().v - before).norm(), 1e-9);
  // However far it is dragged, up stays up.
  EXPECT_GT(camera.stage_from_eye().rotation().column(1).y, 0.0);
  camera.zoom(1000.0);
  EXPECT_TRUE(camera.stage_from_eye().translation().is_finite());
  camera.pan({0.5, 0.0});
  EXPECT_GT((focus().v - before).norm(), 0.01);
}

TEST(Camera, MagnifiesOnlyWithTheEye) {
  Camera camera;
  camera.orbit({0.3, 0.3});
  EXPECT_EQ(camera, Camera());
  camera.zoom(2.0);
  EXPECT_GT(camera.magnification(), 1.1);
  camera.zoom(-100.0);
  EXPECT_EQ(camera.magnification(), 1.0);
}

TEST(ErrorSources, HaveTheirDefaultsOnTheSliderAndBothEndsAreAllowed) {
  const sim::ErrorModel usual;
  for (const ErrorSource& source : error_sources()) {
    const double shown = usual.*source.value * source.scale;
    EXPECT_GE(shown, source.least) << source.name;
    EXPECT_LE(shown, source.most) << source.name;
    for (const double end : {source.least, source.most}) {
      sim::ErrorModel error_model;
      error_model.*source.value = end / source.scale;
      EXPECT_THAT(error_model.check(), IsEmpty()) << source.name << " " << end;
    }
  }
}

}  // namespace
}  // namespace orthonav::preview::model_test
