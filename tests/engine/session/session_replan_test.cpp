// Screws that are changed in surgery: docs/decisions/0071-the-plan-in-use.md.
#include <gmock/gmock.h>

#include <cmath>

#include "base/angle.h"
#include "engine/holograms/visibility.h"
#include "engine/phantom/phantom.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/replan_session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_replan_test {
namespace {

using nav::DrillPhase;
using test::guide_at;
using test::notice_of;
using test::said;
using test::step_of;
using ::testing::HasSubstr;

TEST_F(SessionReplan, ASizeIsInUseAtOnceAndThePlanBeforeStays) {
  const Guidance& g = s.says("screw five five thirty");
  EXPECT_NEAR(s.left().radius_m, 2.75 * kMm, kExact);
  EXPECT_NEAR(nav::screw_length_m(s.left()), 30 * kMm, kExact);
  EXPECT_EQ(s.left().entry.v, kLeftEntry);
  EXPECT_EQ(s.level().screws[0].preoperative.radius_m, 3 * kMm);
  EXPECT_NEAR(nav::screw_length_m(s.level().screws[0].preoperative), 35 * kMm, kExact);
  ASSERT_NE(said<ScrewReplanned>(g), nullptr);
  EXPECT_EQ(notice_of(g), Notice::kReplanned);
  EXPECT_THAT(detail_text(g.status), HasSubstr("L4 left 5.5 \u00d7 30 mm, clearance 6.0 mm"));
  EXPECT_THAT(detail_text(g.status), HasSubstr("; 5.5 \u00d7 30 mm instead of 6.0 \u00d7 35 mm"));
}

TEST_F(SessionReplan, EverybodyGuidesOnThePlanInUseInTheVeryPair) {
  s.tracker().guide = guide_at(kLeftEntry, 0.0);
  ASSERT_NEAR(s.pair().tool->measured->tip_off_axis_m, 0.0, kExact);
  const Guidance& g = s.says("move cranial two");
  ASSERT_TRUE(g.tool && g.tool->measured && g.tool->numbers);
  EXPECT_NEAR(g.tool->measured->tip_off_axis_m, 2 * kMm, kExact);
  EXPECT_NEAR(g.tool->shown.tip_off_axis_m, 2 * kMm, kExact);
  EXPECT_NEAR((g.tool->measured->a.v - (kLeftEntry + Vec3{0, 0, 2 * kMm})).norm(), 0.0, kExact);
  EXPECT_EQ(g.tool->numbers->tip_cranial.tenths, -20) << "written anew, not held back";
  Visibility visible;
  decide_visibility(g, {}, g.display_time, visible);
  ASSERT_TRUE(visible.trajectory);
  EXPECT_NEAR(visible.trajectory->plan().entry.v.z, 2 * kMm, kExact) << "H3, H4";
}

TEST_F(SessionReplan, ErrorsToExpectAreThoseOfThePlanInUse) {
  std::array<double, 36> turns{};
  turns[21] = turns[28] = turns[35] = 1e-4;  // rotations alone, about the origin
  s.registration.uncertainty = nav::PoseUncertainty({0, 0, 0}, turns);
  s.says("reject");
  s.tracker().pointer = test::pointer_at({0, 0.02, 0});
  s.strokes(5);
  s.says("save");
  s.does({ClickerAction::kDoubleClick});
  s.accepts();
  s.says("next");
  const double before_m = s.level().predicted[0].entry_m;
  s.says("move lateral nine");
  EXPECT_GT(s.level().predicted[0].entry_m, 1.1 * before_m) << "farther from the middle";
}

TEST_F(SessionReplan, IsRefusedWhileTheDrillIsSetOrDrills) {
  s.tracker().guide = guide_at(kLeftEntry, 0.0);
  ASSERT_EQ(s.pairs(20).drill.phase, DrillPhase::kSet);
  EXPECT_EQ(s.refusal("move cranial one"), Kind::kDrillSet);
  EXPECT_EQ(s.pair().drill.phase, DrillPhase::kSet) << "watched as before";
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, -0.004, 0}, 0.0);
  ASSERT_EQ(s.pair().drill.phase, DrillPhase::kDrilling);
  EXPECT_EQ(s.refusal("longer"), Kind::kDrilling);
  EXPECT_EQ(s.refusal("undo"), Kind::kDrilling);
  s.tracker().guide.reset();
  s.pairs(20);
  EXPECT_EQ(s.refusal("longer"), Kind::kDrilling) << "a hidden drill may be anywhere";
  EXPECT_EQ(nav::screw_length_m(s.left()), 35 * kMm);
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.0);
  ASSERT_EQ(s.pair().drill.phase, DrillPhase::kAway);
  s.says("shorter");
  EXPECT_NEAR(nav::screw_length_m(s.left()), 30 * kMm, kExact) << "the twin, drawn out";
}

TEST_F(SessionReplan, WhatWasAtDepthOnThePlanBeforeIsForgotten) {
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, -0.020, 0}, 0.0);
  s.pairs(3);
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.0);
  s.pair();
  s.says("move cranial one");
  s.tracker().guide.reset();
  s.says("next");
  ASSERT_TRUE(s.level().screws[0].executed.has_value());
  EXPECT_LT(s.level().screws[0].executed->depth_m, 0.0) << "of what was measured since";
}

TEST_F(SessionReplan, UndoTakesChangesBackOneByOne) {
  s.says("move cranial one");
  s.says("shorter");
  s.says("tilt medial two");
  EXPECT_EQ(s.level().screws[0].earlier_plans.size(), 3u);
  s.says("undo");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().screws[0].preoperative, s.left()), 0.0, kExact);
  EXPECT_NEAR(nav::screw_length_m(s.left()), 30 * kMm, kExact);
  s.says("undo");
  EXPECT_NEAR(nav::screw_length_m(s.left()), 35 * kMm, kExact);
  EXPECT_NEAR(s.left().entry.v.z, kMm, kExact);
  const auto* last = said<ScrewReplanned>(s.says("undo"));
  ASSERT_NE(last, nullptr);
  EXPECT_TRUE(last->undone && last->as_before_surgery);
  EXPECT_EQ(s.left().entry.v, s.level().screws[0].preoperative.entry.v) << "to the bit";
  EXPECT_EQ(s.left().target.v, s.level().screws[0].preoperative.target.v);
  EXPECT_FALSE(s.level().screws[0].replanned());
  EXPECT_EQ(s.refusal("undo"), Kind::kNothingToUndo);
}

TEST_F(SessionReplan, EachScrewHasItsOwnChanges) {
  s.says("move cranial one");
  s.says("next");
  ASSERT_EQ(step_of(s.pair()), "guide L4 right");
  EXPECT_EQ(s.refusal("undo"), Kind::kNothingToUndo);
  s.says("move medial one");
  EXPECT_NEAR(s.level().plan.screws[1].entry.v.x, -14 * kMm, kExact) << "to the midline";
  EXPECT_NEAR(s.left().entry.v.z, kMm, kExact) << "what is done stays";
}

TEST(Replanning, OnAVertebraTheEntryStaysOnTheBoneAndTheStepIsExact) {
  const Case spine = phantom({"L4"});
  const CaseLevel& level = *spine.find("L4");
  const auto model = nav::VertebraModel::prepare(level.mesh).value();
  for (const nav::ScrewPlan& screw : level.screws) {
    for (const auto direction : {nav::ScrewDirection::kCranial, nav::ScrewDirection::kCaudal,
                                 nav::ScrewDirection::kMedial, nav::ScrewDirection::kLateral}) {
      const auto made =
          changed(MoveScrew{nav::ScrewPart::kWhole, direction, 2 * kMm}, screw, screw, *model, {});
      const auto* moved = std::get_if<nav::ScrewPlan>(&made);
      ASSERT_NE(moved, nullptr) << name_of(screw.side) << static_cast<int>(direction);
      EXPECT_LT(model->reachable_surface().nearest(moved->entry.v)->distance_m, 1e-6);
      const nav::ScrewDifference d = nav::difference_of(screw, *moved);
      EXPECT_NEAR(std::hypot(d.entry_cranial_m, d.entry_medial_m), 2 * kMm, 1e-8);
      EXPECT_LT(std::abs(d.entry_inward_m), 6 * kMm);
      EXPECT_NEAR(nav::screw_length_m(*moved), nav::screw_length_m(screw), 1e-9);
      EXPECT_NEAR(nav::tilt_between_rad(screw, *moved), 0.0, 1e-7);
    }
  }
}

}  // namespace
}  // namespace orthonav::engine::session_replan_test
