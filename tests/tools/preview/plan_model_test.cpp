#include "tools/preview/planning/plan_model.h"

#include <gmock/gmock.h>

#include "engine/phantom/phantom.h"
#include "nav/guidance/changed_screw.h"
#include "tools/preview/planning/plan_script.h"

namespace orthonav::preview::plan_model_test {
namespace {

using ::testing::HasSubstr;

constexpr double kAspect = 1.5;
constexpr double kMm = 1e-3;

/// A copy for each test: preparing the bones takes longest.
engine::PlanEditor edited() {
  static const engine::PlanEditor kPrepared = [] {
    return engine::PlanEditor::create(engine::phantom({"L4", "L5"}), engine::ScrewSizes::built_in())
        .value();
  }();
  return kPrepared;
}

/// The upper left pane is looked at; a place in its slice in the mouse's coordinates.
Vec2 mouse_at(const PlanModel& model, Point<Vertebra> place) {
  const engine::SlicePlane& plane = model.slices().axial;
  const Vec2 at = (1.0 / (2.0 * plane.half_m)) * plane.in_plane(place);
  return {0.25 * kAspect + 0.5 * at.x, 0.25 - 0.5 * at.y};
}

struct PlanModelTest : ::testing::Test {
  engine::PlanEditor editor = edited();
  PlanModel model{editor};

  PlanModelTest() { model.set_aspect(kAspect); }
  void tap(char c) {
    model.key(key_of(c), true);
    model.key(key_of(c), false);
  }
};

TEST(PlanPanes, LieInTheFourCorners) {
  EXPECT_EQ(pane_place({0.1, 0.1}, kAspect).pane, Pane::kAxial);
  EXPECT_EQ(pane_place({1.4, 0.1}, kAspect).pane, Pane::kSagittal);
  EXPECT_EQ(pane_place({0.1, 0.9}, kAspect).pane, Pane::kAcross);
  const PanePlace space = pane_place({1.4, 0.9}, kAspect);
  EXPECT_EQ(space.pane, Pane::kSpace);
  EXPECT_NEAR(space.at.x, 2.0 * (1.4 - 1.125), 1e-12);
  EXPECT_NEAR(space.at.y, 2.0 * (0.75 - 0.9), 1e-12) << "up is positive";
}

TEST_F(PlanModelTest, LaysItsSlicesThroughTheScrew) {
  for (int i = 0; i < 4; ++i) {
    const nav::ScrewPlan& screw = *editor.screw();
    for (const Pane pane : {Pane::kAxial, Pane::kSagittal}) {
      const engine::SlicePlane& plane = model.slice(pane);
      EXPECT_NEAR((screw.entry - plane.centre).dot(plane.toward()), 0.0, 1e-12);
      EXPECT_NEAR((screw.target - plane.centre).dot(plane.toward()), 0.0, 1e-12);
    }
    EXPECT_GT(model.slices().axial.right.x, 0.8) << "the patient's left is at the right";
    EXPECT_GT(model.slices().sagittal.right.y, 0.8) << "the front is at the left";
    EXPECT_GT(model.slices().across.right.x, 0.8) << "the same here";
    // Where it is nearest to the cortex.
    EXPECT_EQ(model.across_m(), editor.clearance()->arc_length_m);
    model.key(Key::kRight, true);
  }
}

TEST_F(PlanModelTest, DragsATargetWithTheMouseWhileTheSlicesStay) {
  const nav::ScrewPlan from = *editor.screw();
  const engine::SlicePlane plane = model.slices().axial;
  model.move(mouse_at(model, from.target));
  model.press();
  ASSERT_TRUE(editor.held());
  const Point<Vertebra> wanted = from.target + 3 * kMm * plane.right;
  model.move(mouse_at(model, from.target + 1 * kMm * plane.right));
  model.move(mouse_at(model, wanted));
  EXPECT_EQ(model.slices().axial.centre, plane.centre);
  const Vec3 aim = (editor.screw()->target - from.entry).normalized();
  EXPECT_LT(aim.cross((wanted - from.entry).normalized()).norm(), 1e-9);
  model.release();
  EXPECT_FALSE(model.slices().axial.centre == plane.centre) << "laid through the screw again";
  EXPECT_FALSE(editor.held());
  model.move({0.3, 0.3});
  tap('z');
  EXPECT_LT((editor.screw()->target - from.target).norm(), 1e-12);
}

TEST_F(PlanModelTest, HoldsTheScrewByItsMiddleAndNothingBesideIt) {
  const nav::ScrewPlan from = *editor.screw();
  const Point<Vertebra> middle = from.entry + 0.5 * (from.target - from.entry);
  model.move(mouse_at(model, middle + 20 * kMm * model.slices().axial.right));
  model.press();
  EXPECT_FALSE(editor.held());
  model.move(mouse_at(model, middle));
  model.release();
  EXPECT_FALSE(editor.unsaved());
  model.press();
  ASSERT_TRUE(editor.held());
  model.move(mouse_at(model, middle + 1 * kMm * model.slices().axial.right));
  model.release();
  const nav::ScrewPlan& now = *editor.screw();
  EXPECT_LT(
      (now.target - now.entry).normalized().cross((from.target - from.entry).normalized()).norm(),
      1e-9)
      << "moved as a whole";
  EXPECT_TRUE(editor.unsaved());
}

TEST_F(PlanModelTest, TurnsTheBoneAndScrollsWhereTheMouseIs) {
  const auto eye = model.vertebra_from_eye();
  EXPECT_LT(eye.translation().z, -0.2) << "from below";
  EXPECT_GT(eye.translation().y, 0.1) << "and a little from behind";
  EXPECT_GT(eye.rotation().column(0).x, 0.99) << "the patient's left is at the right here too";
  model.move({1.2, 0.75});
  model.press();
  model.move({1.3, 0.75});
  model.release();
  EXPECT_GT((model.vertebra_from_eye().translation() - eye.translation()).norm(), 0.05);
  const double across_m = model.across_m();
  model.move({0.1, 0.9});
  model.scroll(-2.0);
  EXPECT_NEAR(model.across_m(), across_m + 2 * kMm, 1e-12);
  const double half_m = model.slices().axial.half_m;
  model.move({0.1, 0.1});
  model.scroll(1.0);
  EXPECT_LT(model.slices().axial.half_m, half_m);
  tap('o');
  EXPECT_EQ(model.slices().axial.half_m, half_m);
  EXPECT_EQ(model.across_m(), across_m);
}

TEST_F(PlanModelTest, MakesTheScanWiderAndBrighterBesideTheScrew) {
  const Point<Vertebra> beside = editor.screw()->target + 25 * kMm * model.slices().axial.right;
  const auto drag = [&] {
    model.move(mouse_at(model, beside));
    model.press();
    model.move(mouse_at(model, beside) + Vec2{0.1, -0.05});
    model.release();
  };
  drag();
  EXPECT_EQ(model.window().black_hu, engine::kBoneWindow.black_hu) << "no scan is there";
  model.set_over_scan(true);
  drag();
  const engine::GreyWindow window = model.window();
  EXPECT_NEAR(window.white_hu - window.black_hu, 1500.0 + 400.0, 1e-6);
  EXPECT_NEAR(0.5 * (window.white_hu + window.black_hu), 500.0 - 200.0, 1e-6);
  EXPECT_FALSE(editor.unsaved());
  tap('o');
  EXPECT_EQ(model.window().white_hu, engine::kBoneWindow.white_hu);
}

TEST_F(PlanModelTest, QuitsWithoutSavingAtTheSecondCall) {
  tap(']');
  ASSERT_TRUE(editor.unsaved());
  tap('x');
  EXPECT_FALSE(model.wishes().quit);
  EXPECT_THAT(model.note(), HasSubstr("once more quits without saving"));
  tap('[');
  tap('x');
  EXPECT_FALSE(model.wishes().quit) << "there was a change between the two";
  tap('x');
  EXPECT_TRUE(model.wishes().quit && model.wishes().discard);
}

TEST_F(PlanModelTest, SaysWhyAChangeIsRefused) {
  for (int i = 0; i < 9; ++i) {
    tap('.');
  }
  EXPECT_THAT(model.note(), HasSubstr("is the last of the list"));
  tap('z');
  EXPECT_EQ(model.note(), "");
  EXPECT_FALSE(model.drag(Pane::kAxial, nav::ScrewPart::kWhole, {0.2, 0.0}));
  EXPECT_EQ(model.note(), "no screw can lie there");
}

TEST_F(PlanModelTest, PerformsAScriptUpToItsFirstRefusal) {
  std::vector<std::string> taken;
  const ScriptStage stage{[](int, int) {}, [&](const std::string& name) { taken.push_back(name); }};
  const auto run = [&](const std::string& text) {
    Script script = Script::parse(text, "s", plan_script_words()).value();
    return script.advance([&](const ScriptLine& line) { return perform(line, model, stage); });
  };
  ASSERT_TRUE(run("select L5 right\nkey ]\ndrag sagittal target 0 1\nscreenshot a.png\n").ok());
  EXPECT_EQ(editor.place(), (engine::ScrewPlace{1, nav::Side::kRight}));
  EXPECT_NEAR(nav::screw_length_m(*editor.screw()), 50 * kMm, 1e-9);
  EXPECT_EQ(taken, std::vector<std::string>{"a.png"});
  EXPECT_THAT(run("say nothing\n").error().message, HasSubstr("s:1: say: \"nothing\" is not"));
  for (const char* bad : {"select L9 left", "select L4", "drag space screw 1 1",
                          "drag axial tip 1 1", "drag axial screw 1", "key k"}) {
    EXPECT_FALSE(run(std::string("key o\n") + bad + "\n").ok()) << bad;
  }
  EXPECT_FALSE(Script::parse("until guide\n", "s", plan_script_words()).ok());
  EXPECT_FALSE(Script::parse("resize 63 480\n", "s", plan_script_words()).ok());
  EXPECT_TRUE(Script::parse("resize 64 480\n", "s", plan_script_words()).ok());
}

}  // namespace
}  // namespace orthonav::preview::plan_model_test
