// A wire beyond a limit: its screw is redone, or its plan is changed to suit it.
#include <gmock/gmock.h>

#include "engine/session/text/wording.h"
#include "tests/engine/session/placed_session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_placed_test {
namespace {

using test::notice_of;
using test::said;
using test::step_of;
using ::testing::HasSubstr;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;

SessionOptions hole_of(double drill_diameter_m) {
  SessionOptions options;
  options.placed.drill_diameter_m = drill_diameter_m;
  return options;
}

TEST_F(PlacedSession, NobodyGoesBackToTheHole) {
  measures(0.0025, 0.0);
  s.says("delete");
  const Point<Vertebra> entry = level().plan.screws[0].entry;
  const auto* refusal = said<ReplanRefusal>(s.says("undo"));
  ASSERT_NE(refusal, nullptr);
  EXPECT_EQ(refusal->kind, ReplanRefusal::Kind::kNothingToUndo);
  EXPECT_EQ(level().plan.screws[0].entry, entry);
  EXPECT_TRUE(level().screws[0].replanned()) << "the status line says so";
  // Later changes can be undone back to this plan.
  ASSERT_NE(said<ScrewReplanned>(s.says("move cranial one")), nullptr);
  EXPECT_NE(level().plan.screws[0].entry, entry);
  ASSERT_NE(said<ScrewReplanned>(s.says("undo")), nullptr);
  EXPECT_EQ(level().plan.screws[0].entry, entry);
  ASSERT_NE(said<ReplanRefusal>(s.says("undo")), nullptr);
}

TEST_F(PlacedSession, DeleteRedoesItThroughAnotherEntryOnceTheLandmarkWasTouched) {
  const Point<Vertebra> target = level().plan.screws[0].target;
  measures(0.0025, 0.0);
  const Guidance& g = s.says("delete");
  EXPECT_EQ(step_of(g), "landmark L4");
  ASSERT_NE(said<ScrewRedone>(g), nullptr);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kTouchMore);
  const nav::ScrewPlan& plan = level().plan.screws[0];
  const Point<Vertebra> hole{kLeftEntry + Vec3{0.0025, 0, 0}};
  EXPECT_GE((plan.entry - hole).norm(), PlacedWireRules{}.drill_diameter_m - kJoined);
  EXPECT_NEAR(said<ScrewRedone>(g)->from_hole_m, (plan.entry - hole).norm(), kJoined);
  EXPECT_GT(said<ScrewRedone>(g)->clearance_m, 0.0);
  EXPECT_EQ(plan.target, target);
  EXPECT_NEAR(plan.entry.v.y, 0.020, kExact) << "on the bone's surface";
  EXPECT_FALSE(level().screws[0].done);
  EXPECT_EQ(level().screws[0].redone, 1);
  EXPECT_TRUE(level().accepted);
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark) << "the landmark comes first";
  s.touches_landmark();
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left") << "the same screw";
  s.says("next");
  EXPECT_EQ(s.pair().wire, nullptr) << "what was measured is of the wire that is out";
}

TEST_F(PlacedSession, DeleteIsOfAWireBeyondALimitAlone) {
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNothingToDelete);
  measures(0.0005, 0.0);
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNotPossibleNow);
  EXPECT_EQ(step_of(s.pair()), "measure L4 left");
  EXPECT_NE(s.pair().wire, nullptr);
}

TEST_F(PlacedSession, ASecondTimeDeleteMustBeSaidAgain) {
  measures(0.0025, 0.0);
  s.says("delete");
  drill();
  ASSERT_EQ(step_of(s.pair()), "measure L4 left");
  measures(0.0025, 0.0);
  ASSERT_NE(said<ConfirmRedo>(s.says("delete")), nullptr);
  EXPECT_EQ(step_of(s.pair()), "measure L4 left");
  EXPECT_EQ(step_of(s.says("delete")), "landmark L4");
  EXPECT_EQ(level().screws[0].redone, 2);
}

TEST_F(PlacedSession, AMeasurementComesBetweenTheTwoDeletes) {
  measures(0.0025, 0.0);
  s.says("delete");
  drill();
  measures(0.0025, 0.0);
  s.says("delete");
  measures(0.0027, 0.0);
  EXPECT_NE(said<ConfirmRedo>(s.says("delete")), nullptr) << "the first one was of another";
}

class NoRoomSession : public PlacedSession {
 protected:
  /// Nowhere within reach of the entry is as far from the hole.
  NoRoomSession() : PlacedSession(hole_of(0.010)) {}
};

TEST_F(NoRoomSession, OffersOnlyToKeepIt) {
  measures(0.0, 0.05);
  const Guidance& g = s.says("delete");
  EXPECT_EQ(step_of(g), "measure L4 left");
  ASSERT_NE(said<NoOtherEntry>(g), nullptr);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kKeepWire);
  EXPECT_EQ(checks_asked(s.pairs(120).status), ChecksAsked::kKeepWire) << "without the message";
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("no other entry stays inside the bone"));
  EXPECT_EQ(level().plan.screws[0].entry.v, kLeftEntry);
  EXPECT_EQ(level().screws[0].redone, 0);
  s.says("accept");
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
}

TEST_F(PlacedSession, APlanIsChangedToSuitTheWire) {
  // +x is left of the patient, so lateral of a left screw.
  ASSERT_FALSE(measures(0.0025, 0.0).wire->within());
  const Guidance& g = s.says("move lateral two");
  ASSERT_NE(said<ScrewReplanned>(g), nullptr);
  EXPECT_EQ(step_of(g), "measure L4 left");
  EXPECT_NEAR(level().plan.screws[0].entry.v.x, kLeftEntry.x + 0.002, 1e-4);
  ASSERT_NE(s.pair().wire, nullptr);
  EXPECT_NEAR(s.pair().wire->axis.entry_m.value, 0.0005, 1e-4);
  EXPECT_TRUE(s.pair().wire->within());
  EXPECT_TRUE(level().screws[0].replanned());
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
  EXPECT_TRUE(level().screws[0].executed) << "where the tool went is not forgotten";
}

TEST_F(PlacedSession, APlanThatSuitsItLessStillWaitsForAWord) {
  measures(0.0025, 0.0);
  s.says("move medial two");
  EXPECT_NEAR(s.pair().wire->axis.entry_m.value, 0.0045, 1e-4);
  EXPECT_EQ(step_of(s.says("next")), "measure L4 left");
  EXPECT_EQ(step_of(s.says("delete")), "landmark L4");
}

TEST_F(PlacedSession, NoPlanIsChangedAwayFromAWireThatNobodyLookedAt) {
  const auto refused = [this] {
    const auto* refusal = said<ReplanRefusal>(s.says("move lateral two"));
    return refusal != nullptr && refusal->kind == ReplanRefusal::Kind::kWireIn;
  };
  EXPECT_TRUE(refused()) << "not measured";
  measures(0.0005, 0.0);
  EXPECT_TRUE(refused()) << "nothing waits";
  EXPECT_EQ(level().plan.screws[0].entry.v, kLeftEntry);
}

}  // namespace
}  // namespace orthonav::engine::session_placed_test
