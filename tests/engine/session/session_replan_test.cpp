// Screws that are changed in surgery: docs/decisions/0071-the-plan-in-use.md.
#include <gmock/gmock.h>

#include <cmath>

#include "base/angle.h"
#include "engine/holograms/visibility.h"
#include "engine/phantom/phantom.h"
#include "engine/session/session.h"
#include "engine/session/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_replan_test {
namespace {

using nav::DrillPhase;
using test::guide_at;
using test::notice_of;
using test::said;
using test::ScriptedOperation;
using test::step_of;
using Kind = ReplanRefusal::Kind;
using ::testing::HasSubstr;

constexpr double kExact = 1e-9;
constexpr double kMm = 1e-3;
/// Tolerance of the search for the least depth on the faces of a box.
constexpr double kSearch_m = 5e-6;
constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};

/// The box's screws are 6 × 35 mm, straight in along -y; its walls are at x = ±30 and z = ±25 mm.
struct Replan4 : ScriptedOperation {
  explicit Replan4(const SessionOptions& options = {},
                   Verification verification = Verification::kByEye)
      : ScriptedOperation({"L4", "L5"}, options, verification) {
    registers_within(0.0004);
    tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.030, 0}, 0.0);
  }
  const LevelState& level() { return session().levels()[0]; }
  const nav::ScrewPlan& left() { return level().plan.screws[0]; }
  void guides_left() {
    accepts_first_level();
    says("next");
  }
  Kind refusal(const std::string& phrase) {
    const auto* refused = said<ReplanRefusal>(says(phrase));
    EXPECT_NE(refused, nullptr) << phrase;
    return refused ? refused->kind : Kind::kNothingToUndo;
  }
};

class SessionReplan : public ::testing::Test {
 protected:
  SessionReplan() { s.guides_left(); }
  Replan4 s;
};

TEST_F(SessionReplan, ASizeIsInUseAtOnceAndThePlanBeforeStays) {
  const Guidance& g = s.says("screw five five thirty");
  EXPECT_NEAR(s.left().radius_m, 2.75 * kMm, kExact);
  EXPECT_NEAR(nav::screw_length_m(s.left()), 30 * kMm, kExact);
  EXPECT_EQ(s.left().entry.v, kLeftEntry);
  EXPECT_EQ(s.level().preoperative[0].radius_m, 3 * kMm);
  EXPECT_NEAR(nav::screw_length_m(s.level().preoperative[0]), 35 * kMm, kExact);
  ASSERT_NE(said<ScrewReplanned>(g), nullptr);
  EXPECT_EQ(notice_of(g), Notice::kReplanned);
  EXPECT_THAT(detail_text(g.status), HasSubstr("L4 left 5.5 \u00d7 30 mm, clearance 6.0 mm"));
  EXPECT_THAT(detail_text(g.status), HasSubstr("; 5.5 \u00d7 30 mm instead of 6.0 \u00d7 35 mm"));
  const auto* figures = test::state<RegistrationFigures>(s.pairs(100));
  ASSERT_NE(figures, nullptr);
  EXPECT_TRUE(figures->replanned) << "and the line goes on saying so";
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
  ASSERT_TRUE(s.level().executed[0].has_value());
  EXPECT_LT(s.level().executed[0]->depth_m, 0.0) << "of what was measured since";
}

TEST_F(SessionReplan, TheEntryMovesTenMillimetresInAllAndNoMore) {
  s.says("move cranial nine");
  s.says("move cranial one");
  EXPECT_NEAR(s.left().entry.v.z, 10 * kMm, kExact) << "the limit itself";
  const auto* refused = said<ReplanRefusal>(s.says("entry cranial 0.1"));
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->kind, Kind::kEntryTooFar);
  EXPECT_NEAR(refused->value, 10.1 * kMm, kExact);
  EXPECT_NEAR(s.left().entry.v.z, 10 * kMm, kExact);
  s.says("move caudal five");
  EXPECT_NEAR(s.left().entry.v.z, 5 * kMm, kExact) << "back is always possible";
}

TEST_F(SessionReplan, TheAxisTiltsFifteenDegreesInAllAndNoMore) {
  s.says("tilt cranial nine");
  s.says("tilt cranial six");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().preoperative[0], s.left()), 15 * kRadiansPerDegree,
              kExact);
  EXPECT_EQ(s.refusal("tilt cranial 0.1"), Kind::kTiltTooFar);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("limit 15.0\u00b0"));
  EXPECT_EQ(s.refusal("target cranial one"), Kind::kTiltTooFar);
  s.says("tilt caudal two");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().preoperative[0], s.left()), 13 * kRadiansPerDegree,
              kExact);
}

TEST_F(SessionReplan, SizesAreThoseOfTheList) {
  EXPECT_EQ(s.refusal("screw six thirty two"), Kind::kNoSuchSize);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("6.0 \u00d7 32 mm is not in the list"));
  EXPECT_EQ(s.refusal("diameter eight"), Kind::kNoSuchSize);
  EXPECT_EQ(s.refusal("length twenty"), Kind::kNoSuchSize);
  s.says("thinner");
  EXPECT_NEAR(s.left().radius_m, 2.75 * kMm, kExact);
  s.says("thinner");
  s.says("thinner");
  EXPECT_EQ(s.refusal("thinner"), Kind::kLastSize);
  EXPECT_NEAR(s.left().radius_m, 2.25 * kMm, kExact);
}

TEST_F(SessionReplan, AListOfItsOwnAndLimitsAreOptions) {
  SessionOptions options;
  options.replan.sizes = {{{0.006, {0.032}, {}}}};
  options.replan.entry_m = 0.002;
  Replan4 own(options);
  own.guides_left();
  own.says("screw six thirty two");
  EXPECT_NEAR(nav::screw_length_m(own.left()), 32 * kMm, kExact);
  EXPECT_EQ(own.refusal("move cranial three"), Kind::kEntryTooFar);
  options.replan.entry_m = 0.05;
  EXPECT_THAT(options.check(), ::testing::ElementsAre(HasSubstr("replan: entry_m")));
}

TEST_F(SessionReplan, UndoTakesChangesBackOneByOne) {
  s.says("move cranial one");
  s.says("shorter");
  s.says("tilt medial two");
  EXPECT_EQ(s.level().earlier_plans[0].size(), 3u);
  s.says("undo");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().preoperative[0], s.left()), 0.0, kExact);
  EXPECT_NEAR(nav::screw_length_m(s.left()), 30 * kMm, kExact);
  s.says("undo");
  EXPECT_NEAR(nav::screw_length_m(s.left()), 35 * kMm, kExact);
  EXPECT_NEAR(s.left().entry.v.z, kMm, kExact);
  const auto* last = said<ScrewReplanned>(s.says("undo"));
  ASSERT_NE(last, nullptr);
  EXPECT_TRUE(last->undone && last->as_before_surgery);
  EXPECT_EQ(s.left().entry.v, s.level().preoperative[0].entry.v) << "to the bit";
  EXPECT_EQ(s.left().target.v, s.level().preoperative[0].target.v);
  EXPECT_FALSE(s.level().replanned(0));
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

TEST_F(SessionReplan, ABreachIsRefusedUntilItIsAccepted) {
  s.says("move lateral nine");
  const auto* refused = said<ReplanRefusal>(s.says("thicker"));
  EXPECT_EQ(refused, nullptr) << "x = 24 + 3.25: still in the bone";
  s.says("tilt lateral nine");
  const Guidance& g = s.pair();
  ASSERT_NE(said<ReplanRefusal>(g), nullptr);
  EXPECT_EQ(said<ReplanRefusal>(g)->kind, Kind::kBreach);
  const double reach_m = 24 * kMm + 35 * kMm * std::sin(9 * kRadiansPerDegree) +
                         3.25 * kMm * std::cos(9 * kRadiansPerDegree);
  EXPECT_NEAR(said<ReplanRefusal>(g)->value, 30 * kMm - reach_m, kSearch_m + 1e-5);
  EXPECT_THAT(detail_text(g.status), HasSubstr("(tip): say accept to take it"));
  EXPECT_NEAR(nav::tilt_between_rad(s.level().preoperative[0], s.left()), 0.0, kExact)
      << "not before it is accepted";
  const Guidance& taken = s.says("accept");
  ASSERT_NE(said<ScrewReplanned>(taken), nullptr);
  EXPECT_EQ(s.left().accepted_breach, "accepted in surgery");
  EXPECT_NEAR(nav::tilt_between_rad(s.level().preoperative[0], s.left()), 9 * kRadiansPerDegree,
              kExact);
  s.says("tilt medial one");
  EXPECT_EQ(s.left().accepted_breach, "accepted in surgery") << "no worse: not asked again";
  EXPECT_EQ(s.refusal("tilt lateral two"), Kind::kBreach) << "worse";
  s.says("undo");
  s.says("undo");
  EXPECT_TRUE(s.left().accepted_breach.empty()) << "with the change its reason goes";
}

TEST_F(SessionReplan, AReasonEndsWithItsBreach) {
  s.says("move lateral nine");
  ASSERT_EQ(s.refusal("tilt lateral nine"), Kind::kBreach);
  s.pair();
  s.says("accept");
  ASSERT_FALSE(s.left().accepted_breach.empty());
  s.says("tilt medial nine");
  EXPECT_TRUE(s.left().accepted_breach.empty());
  EXPECT_EQ(s.refusal("tilt lateral nine"), Kind::kBreach) << "asked anew";
}

TEST_F(SessionReplan, ConsentCountsOnlyForTheQuestionThatIsShown) {
  s.says("move lateral nine");
  const auto breaks = [&] { return s.refusal("tilt lateral nine") == Kind::kBreach; };
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "nothing was asked";
  s.hears_at(s.now() + std::chrono::milliseconds(1), "tilt lateral nine");
  s.hears_at(s.now() + std::chrono::milliseconds(2), "accept");
  EXPECT_EQ(notice_of(s.pair()), Notice::kNotPossibleNow) << "said before the question was shown";
  ASSERT_TRUE(breaks());
  s.pairs(100);
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "its message is gone";
  ASSERT_TRUE(breaks());
  s.says("twin");
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "something else was done";
  ASSERT_TRUE(breaks());
  s.tracker().guide = guide_at(s.left().entry.v, 0.0);
  s.pairs(20);
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "the drill is set by now";
  EXPECT_NEAR(nav::tilt_between_rad(s.level().preoperative[0], s.left()), 0.0, kExact);
}

TEST(SessionReplanSteps, TheNextScrewIsChangedInAcceptedAndNoneElsewhere) {
  Replan4 s;
  s.registers_first_level();
  EXPECT_EQ(notice_of(s.says("shorter")), Notice::kNotPossibleNow);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("once its level is accepted"));
  s.accepts();
  const auto* done = said<ScrewReplanned>(s.says("shorter"));
  ASSERT_NE(done, nullptr);
  EXPECT_EQ(done->level, "L4");
  EXPECT_EQ(done->to.side, Side::kLeft);
  s.says("next");
  EXPECT_NEAR(nav::screw_length_m(s.left()), 30 * kMm, kExact);
  s.says("next");
  s.says("next");
  EXPECT_EQ(step_of(s.pair()), "digitize L5");
  EXPECT_EQ(notice_of(s.says("shorter")), Notice::kNotPossibleNow);
  EXPECT_EQ(s.level().earlier_plans[0].size(), 1u);
}

TEST(SessionReplanSteps, ByTouchAcceptConsentsFirstAndCorrectsTheTipElse) {
  Replan4 s({}, Verification::kByTouch);
  s.accepts_first_by_touch();
  EXPECT_EQ(notice_of(s.says("accept")), Notice::kNotPossibleNow) << "neither waits";
  s.says("move lateral nine");
  ASSERT_EQ(s.refusal("tilt lateral nine"), Kind::kBreach);
  s.pair();
  s.says("accept");
  EXPECT_EQ(s.left().accepted_breach, "accepted in surgery");
}

TEST(SessionReplanSteps, TheLandmarkOfTheNextScrewIsNotTheLast) {
  Replan4 s({}, Verification::kByTouch);
  s.accepts_first_by_touch();
  s.touches_dimple();
  s.says("next");
  s.says("next");
  s.says("next");  // its wire is not measured
  ASSERT_EQ(step_of(s.pair()), "accepted L4");
  const auto* done = said<ScrewReplanned>(s.says("move cranial one"));
  ASSERT_NE(done, nullptr);
  EXPECT_EQ(done->to.side, Side::kRight) << "the left one is done";
}

TEST(SessionReplanSteps, WhatTheStepAsksForStaysAskedBesideIt) {
  Replan4 s({}, Verification::kByTouch);
  s.accepts_first_by_touch();
  for (const char* phrase : {"shorter", "move cranial", "undo", "undo"}) {
    const Guidance& g = s.says(phrase);
    ASSERT_NE(g.status.message, nullptr) << phrase;
    EXPECT_THAT(detail_text(g.status), HasSubstr("; make a dimple in this bone and touch it"));
    EXPECT_EQ(checks_asked(g.status), ChecksAsked::kTouchMore) << phrase;
  }
}

TEST(SessionReplanSteps, APhraseThatIsNotUnderstoodChangesNothing) {
  Replan4 s;
  s.guides_left();
  EXPECT_EQ(notice_of(s.says("move cranial")), Notice::kNotUnderstood);
  EXPECT_EQ(detail_text(s.pair().status), "move: say how far, such as \"move cranial one\"");
  EXPECT_EQ(notice_of(s.says("move cranial one", 0.4)), Notice::kNotUnderstood) << "not sure";
  EXPECT_EQ(s.left().entry.v, kLeftEntry);
  ASSERT_NE(s.pair().status.heard, nullptr);
  EXPECT_FALSE(s.pair().status.heard->sure);
  s.says("move cranial one", 0.6);
  EXPECT_NEAR(s.left().entry.v.z, kMm, kExact);
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

TEST(SessionReplanSteps, ChangesOutliveTheRegistration) {
  Replan4 s;
  s.guides_left();
  s.says("move cranial one");
  s.says("reject");
  EXPECT_NEAR(s.left().entry.v.z, kMm, kExact) << "they are of the bone";
  EXPECT_TRUE(s.level().replanned(0));
}

}  // namespace
}  // namespace orthonav::engine::session_replan_test
