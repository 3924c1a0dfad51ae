#include "engine/planning/plan_editor.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "engine/case/case_file.h"
#include "engine/phantom/phantom.h"
#include "nav/guidance/changed_screw.h"

namespace orthonav::engine::plan_editor_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double kMm = 1e-3;
constexpr double kTiny_m = 1e-9;

/// An editor of two levels of the phantom: a copy for each test, since preparing the bones takes
/// longest.
PlanEditor edited() {
  static const PlanEditor kPrepared = [] {
    return PlanEditor::create(phantom({"L4", "L5"}), ScrewSizes::built_in()).value();
  }();
  return kPrepared;
}

void expect_same(const nav::ScrewPlan& a, const nav::ScrewPlan& b) {
  EXPECT_EQ(a.side, b.side);
  EXPECT_LT((a.entry - b.entry).norm(), kTiny_m);
  EXPECT_LT((a.target - b.target).norm(), kTiny_m);
  EXPECT_EQ(a.radius_m, b.radius_m);
  EXPECT_EQ(a.accepted_breach, b.accepted_breach);
}

double off_bone_m(const PlanEditor& editor, Point<Vertebra> place) {
  return editor.bone().surface().nearest(place.v)->distance_m;
}

TEST(PlanEditor, TakesBackEveryChangeAndMakesItAgain) {
  PlanEditor editor = edited();
  const nav::ScrewPlan first = *editor.screw();
  EXPECT_FALSE(editor.unsaved());
  ASSERT_TRUE(editor.say("longer").ok());
  ASSERT_TRUE(editor.say("move cranial one").ok());
  editor.select({1, nav::Side::kRight});
  ASSERT_TRUE(editor.say("thinner").ok());
  const Case all_made = editor.subject();
  EXPECT_NEAR(nav::screw_length_m(all_made.levels[0].screws[0]), 50 * kMm, kTiny_m);
  EXPECT_NEAR((all_made.levels[0].screws[0].entry - first.entry).norm(), 1 * kMm, 0.7 * kMm);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(editor.undo().ok());
  }
  EXPECT_EQ(editor.place(), (ScrewPlace{0, nav::Side::kLeft})) << "what is undone is shown";
  expect_same(*editor.screw(), first);
  EXPECT_EQ(editor.undo().error().message, "nothing to undo");
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(editor.redo().ok());
  }
  EXPECT_EQ(editor.redo().error().message, "nothing to redo");
  for (std::size_t level = 0; level < 2; ++level) {
    for (std::size_t screw = 0; screw < 2; ++screw) {
      expect_same(editor.subject().levels[level].screws[screw],
                  all_made.levels[level].screws[screw]);
    }
  }
}

TEST(PlanEditor, DragsTheTargetToAListedLengthAsOneStep) {
  PlanEditor editor = edited();
  const nav::ScrewPlan from = *editor.screw();
  ASSERT_TRUE(editor.grab(nav::ScrewPart::kTarget));
  for (int i = 1; i <= 4; ++i) {
    ASSERT_TRUE(editor.drag({0.0, 0.0, i * 1.1 * kMm}));
  }
  const nav::ScrewPlan& now = *editor.screw();
  EXPECT_EQ(now.entry, from.entry);
  EXPECT_NEAR(nav::screw_length_m(now), 45 * kMm, kTiny_m);
  const Vec3 wanted = from.target + Vec3{0.0, 0.0, 4.4 * kMm} - from.entry;
  EXPECT_LT((now.target - now.entry).normalized().cross(wanted.normalized()).norm(), 1e-9);
  // 4 mm deeper than the end of the list's next step: it snaps.
  ASSERT_TRUE(editor.drag(4 * kMm * (from.target - from.entry).normalized()));
  EXPECT_NEAR(nav::screw_length_m(*editor.screw()), 50 * kMm, kTiny_m);
  editor.drop();
  ASSERT_TRUE(editor.undo().ok());
  expect_same(*editor.screw(), from);
  EXPECT_FALSE(editor.undo().ok()) << "it was one step";
}

TEST(PlanEditor, KeepsADraggedEntryOnTheBone) {
  for (const nav::ScrewPart part : {nav::ScrewPart::kEntry, nav::ScrewPart::kWhole}) {
    PlanEditor editor = edited();
    const nav::ScrewPlan from = *editor.screw();
    ASSERT_TRUE(editor.grab(part));
    ASSERT_TRUE(editor.drag({1.5 * kMm, 0.0, -1.0 * kMm}));
    EXPECT_LT(off_bone_m(editor, editor.screw()->entry), 1e-6);
    EXPECT_GT((editor.screw()->entry - from.entry).norm(), 1.0 * kMm);
    EXPECT_NEAR(nav::screw_length_m(*editor.screw()), 45 * kMm, kTiny_m);
    EXPECT_NEAR(editor.clearance()->clearance_m,
                nav::least_clearance(editor.bone().surface(), *nav::cylinder_of(*editor.screw()))
                    ->clearance_m,
                kTiny_m);
  }
}

TEST(PlanEditor, StaysWhereTheLastValidMoveLeftIt) {
  PlanEditor editor = edited();
  const nav::ScrewPlan from = *editor.screw();
  ASSERT_TRUE(editor.grab(nav::ScrewPart::kWhole));
  EXPECT_FALSE(editor.drag({0.2, 0.0, 0.0})) << "no bone there";
  EXPECT_FALSE(editor.drag({-2.0 * from.entry.v.x, 0.0, 0.0})) << "the other side";
  EXPECT_FALSE(editor.drag({std::nan(""), 0.0, 0.0}));
  expect_same(*editor.screw(), from);
  editor.drop();
  EXPECT_FALSE(editor.unsaved());
  EXPECT_FALSE(editor.drag({kMm, 0.0, 0.0})) << "nothing is held";
}

TEST(PlanEditor, RefusesInOneLine) {
  PlanEditor editor = edited();
  EXPECT_EQ(editor.say("make it better").error().message,
            "\"make it better\" is not a change of a screw");
  EXPECT_THAT(editor.say("screw nine ninety").error().message, HasSubstr("not in the list"));
  ASSERT_TRUE(editor.say("delete").ok());
  EXPECT_EQ(editor.screw(), nullptr);
  EXPECT_FALSE(editor.clearance());
  EXPECT_FALSE(editor.grab(nav::ScrewPart::kTarget));
  for (const char* phrase : {"delete", "breach wanted so", "longer"}) {
    EXPECT_THAT(editor.say(phrase).error().message, HasSubstr("no screw is planned here"))
        << phrase;
  }
  EXPECT_FALSE(PlanEditor::create({}, ScrewSizes::built_in()).ok());
}

TEST(PlanEditor, PlansAnewAndSavesWhatLoadsAgain) {
  PlanEditor editor = edited();
  ASSERT_TRUE(editor.say("delete").ok());
  ASSERT_TRUE(editor.say("auto").ok());
  ASSERT_TRUE(editor.clearance());
  EXPECT_GT(editor.clearance()->clearance_m, 1 * kMm);
  ASSERT_TRUE(editor.say("breach  in-out-in, as discussed").ok());
  editor.select_beside(false);
  EXPECT_EQ(editor.place(), (ScrewPlace{1, nav::Side::kRight}));
  ASSERT_TRUE(editor.remove().ok());
  const fs::path folder = fs::path(::testing::TempDir()) / "plan-editor";
  fs::remove_all(folder);
  fs::create_directories(folder);
  ASSERT_TRUE(editor.save(folder.string()).ok());
  EXPECT_FALSE(editor.unsaved());
  EXPECT_FALSE(editor.save(folder.string()).ok()) << "nothing is overwritten";
  const auto loaded = load_case(folder.string());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  ASSERT_EQ(loaded->levels[1].screws.size(), 1u);
  EXPECT_EQ(loaded->levels[0].screws[0].accepted_breach, "in-out-in, as discussed");
  EXPECT_LT((loaded->levels[0].screws[0].entry - editor.subject().levels[0].screws[0].entry).norm(),
            1e-6);
  fs::remove_all(folder);
}

TEST(PlanEditor, GoesThroughEveryPlace) {
  PlanEditor editor = edited();
  std::set<std::pair<std::size_t, nav::Side>> seen;
  for (int i = 0; i < 4; ++i) {
    seen.insert({editor.place().level, editor.place().side});
    editor.select_beside(true);
  }
  EXPECT_EQ(seen.size(), 4u);
  EXPECT_EQ(editor.place(), ScrewPlace{}) << "round";
  editor.select({7, nav::Side::kLeft});
  EXPECT_EQ(editor.place(), ScrewPlace{});
}

}  // namespace
}  // namespace orthonav::engine::plan_editor_test
