#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "base/angle.h"
#include "engine/session/session.h"
#include "engine/session/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_placed_test {
namespace {

using test::guide_at;
using test::notice_of;
using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using test::touch_refusal;
using ::testing::HasSubstr;
using enum ClickerAction;
using Kind = TouchRefusal::Kind;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;
/// The places touched to verify the registration move it by micrometres.
constexpr double kJoined = 1e-5;
constexpr double kJust = 5e-5;
constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr double kRegistration_m = 0.0003;

SessionOptions hole_of(double drill_diameter_m) {
  SessionOptions options;
  options.placed.drill_diameter_m = drill_diameter_m;
  return options;
}

/// In `placed`: the first screw was drilled, and "next" was said. World is Vertebra.
class PlacedSession : public ::testing::Test {
 protected:
  explicit PlacedSession(const SessionOptions& options = {}, bool reference = false,
                         double registration_m = kRegistration_m)
      : s({"L4", "L5"}, options, Verification::kByTouch, false, reference) {
    if (registration_m > 0.0) {
      s.registers_within(registration_m);
    }
    s.accepts_first_by_touch();
    drill();
  }
  void drill() {
    s.touches_dimple();
    s.says("next");
    s.tracker().guide = guide_at(kLeftEntry, 0.0);
    s.pairs(3);
    s.says("next");
  }
  /// A click with the sleeve over a wire that passes the entry `beside_m` towards +x and is tilted
  /// by `angle_rad`; `out_m` of it lie between sleeve and entry.
  const Guidance& measures(double beside_m, double angle_rad, double out_m = 0.004) {
    set_over(beside_m, angle_rad, out_m);
    s.does({kPress});
    s.pair();
    return s.does({kRelease, kClick});
  }
  void set_over(double beside_m, double angle_rad, double out_m = 0.004) {
    const Vec3 out = rotation_from_vector({0, 0, angle_rad}) * Vec3{0, 1, 0};
    const Vec3 across = rotation_from_vector({0, 0, angle_rad}) * Vec3{1, 0, 0};
    s.tracker().guide = guide_at(kLeftEntry + beside_m * across + out_m * out, angle_rad);
  }
  const LevelState& level() { return s.session().levels()[0]; }
  ScriptedOperation s;
};

TEST_F(PlacedSession, FollowsEveryScrewAndAsksForTheSleeve) {
  const Guidance& g = s.pair();
  EXPECT_EQ(step_of(g), "placed L4 left");
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kMeasureWire);
  EXPECT_EQ(g.status.tool, "guide");
  EXPECT_EQ(g.wire, nullptr);
  EXPECT_FALSE(g.tool) << "nothing is guided";
  EXPECT_THAT(detail_text(g.status), HasSubstr("set the sleeve over the wire, turn it and click"));
}

TEST_F(PlacedSession, AWireWithinTheLimitsIsToldWithItsSds) {
  const Guidance& g = measures(0.0006, 0.8 * kRadiansPerDegree);
  ASSERT_NE(state<WireSoFar>(g), nullptr);
  ASSERT_NE(state<WireSoFar>(g)->wire, nullptr);
  const PlacedWire& wire = *state<WireSoFar>(g)->wire;
  EXPECT_NEAR(wire.axis.angle_rad.value, 0.8 * kRadiansPerDegree, kJoined);
  EXPECT_NEAR(wire.axis.entry_m.value, 0.0006, kJoined);
  EXPECT_TRUE(wire.within());
  EXPECT_EQ(g.wire, &wire);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kPassed);
  EXPECT_THAT(detail_text(g.status), HasSubstr("placed: 0.8 ± 0.6°, 0.6 ± 0.9 mm from the plan"));
  EXPECT_EQ(step_of(s.says("next")), "accepted L4") << "the landmark before the other screw";
  EXPECT_TRUE(level().screw_done[0]);
  ASSERT_TRUE(level().wires[0].measured);
  EXPECT_FALSE(level().wires[0].measured->kept);
}

TEST_F(PlacedSession, WhereTheSleeveStandsOnTheWireIsTheSame) {
  for (const double out_m : {0.0, 0.010, 0.040}) {
    const Guidance& g = measures(0.0011, -0.02, out_m);
    ASSERT_NE(g.wire, nullptr) << out_m;
    EXPECT_NEAR(g.wire->axis.angle_rad.value, 0.02, kJoined);
    EXPECT_NEAR(g.wire->axis.entry_m.value, 0.0011, kJoined);
  }
}

TEST_F(PlacedSession, TheSdHoldsRegistrationPoseAndCalibration) {
  const PlacedWireRules rules;
  const PlacedWire near = *measures(0.001, 0.01, 0.0).wire;
  const PlacedWire far = *measures(0.001, 0.01, 0.04).wire;
  const double least_m = std::hypot(kRegistration_m, test::guide_sd_m());
  EXPECT_GE(near.axis.entry_m.sd, least_m);
  EXPECT_LT(near.axis.entry_m.sd, 1.3 * least_m);
  EXPECT_GT(far.axis.entry_m.sd, std::hypot(least_m, 0.04 * rules.axis_sd_rad));
  EXPECT_GE(near.axis.angle_rad.sd, std::hypot(rules.axis_sd_rad, rules.play_rad));
  EXPECT_LT(near.axis.angle_rad.sd, 1.1 * std::hypot(rules.axis_sd_rad, rules.play_rad));
}

/// A wire as planned, over which a guide whose axis is off by `off_rad` was turned to and fro by up
/// to `turn_rad`.
const Guidance& measures_turning(ScriptedOperation& s, double off_rad, double turn_rad) {
  constexpr int kPairs = 45;
  const Mat3 off = rotation_from_vector({0, 0, off_rad});
  for (int k = 0; k <= kPairs; ++k) {
    const double roll_rad = turn_rad * std::sin(2.0 * std::numbers::pi * k / kPairs);
    const Mat3 turn = rotation_from_vector({0, roll_rad, 0}) * off.transposed();
    const Vec3 tip = kLeftEntry + Vec3{0, 0.004, 0};
    s.tracker().guide = {turn, tip - turn * guide_at({}, 0.0).inverse().translation()};
    s.pair();
  }
  s.pairs(20);
  s.does({kPress});
  s.pair();
  return s.does({kRelease, kClick});
}

TEST_F(PlacedSession, ATurnedSleeveTellsTheWireWithoutTheGuidesAxis) {
  const double off_rad = 0.02;
  const Guidance& turned = measures_turning(s, off_rad, 1.0);
  ASSERT_NE(turned.wire, nullptr);
  // The error of the guide's axis is found to one fiftieth.
  EXPECT_NEAR(turned.wire->axis.angle_rad.value, 0.0, 0.02 * off_rad);
  EXPECT_LT(turned.wire->axis.angle_rad.sd, PlacedWireRules{}.axis_sd_rad);
  const Guidance& still = measures_turning(s, off_rad, 0.0);
  // An earlier turn is still within the last ten seconds, unless the sleeve was elsewhere.
  ASSERT_NE(still.wire, nullptr);
  set_over(0.0, 0.3);
  s.pair();
  EXPECT_NEAR(measures_turning(s, off_rad, 0.0).wire->axis.angle_rad.value, off_rad, kJoined)
      << "the twin";
}

TEST_F(PlacedSession, TheAxisIsCorrectedWithConsentBeforeTheNextScrew) {
  measures_turning(s, 0.02, 1.0);
  EXPECT_EQ(step_of(s.says("next")), "accepted L4");
  s.says("accept");
  EXPECT_EQ(said<AxisCorrected>(s.pair()), nullptr) << "nothing was offered yet";
  s.touches_dimple();
  EXPECT_EQ(said<AxisCorrected>(s.pair()), nullptr) << "not without a word";
  EXPECT_THAT(detail_text(s.pair().status),
              HasSubstr("guide's axis 1.1° off: say accept to correct it"));
  s.says("accept");
  ASSERT_NE(said<AxisCorrected>(s.pair()), nullptr);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("guide's axis corrected by 1.1°"));
  // The mean by the described axis (0.57 degrees) and by the spin.
  EXPECT_GT(said<AxisCorrected>(s.pair())->by_rad, 0.019);
  EXPECT_LT(said<AxisCorrected>(s.pair())->by_rad, 0.02);
}

TEST_F(PlacedSession, AnAxisThatIsRightIsLeftAlone) {
  measures_turning(s, 0.001, 1.0);
  s.says("next");
  s.touches_dimple();
  s.says("accept");
  EXPECT_EQ(said<AxisCorrected>(s.pair()), nullptr);
}

TEST_F(PlacedSession, NextBeforeAnythingWasMeasuredGoesOnAndIsKnown) {
  EXPECT_EQ(step_of(s.says("next")), "accepted L4");
  EXPECT_TRUE(level().screw_done[0]);
  EXPECT_TRUE(level().wires[0].asked);
  EXPECT_FALSE(level().wires[0].measured);
}

TEST_F(PlacedSession, BeyondALimitNextIsNotTakenBeforeAWord) {
  const double limit_rad = PlacedWireRules{}.angle_limit_rad;
  EXPECT_TRUE(measures(0.0, limit_rad - kJust).wire->within());
  const Guidance& g = measures(0.0, limit_rad + kJust);
  EXPECT_FALSE(g.wire->within());
  EXPECT_TRUE(g.wire->entry_within());
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kDecideOnWire);
  EXPECT_THAT(detail_text(g.status), HasSubstr("limit 2.00"));
  EXPECT_EQ(step_of(s.says("next")), "placed L4 left");
  EXPECT_NE(said<WireUndecided>(s.pair()), nullptr);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kDecideOnWire) << "in a message as well";
  EXPECT_FALSE(level().screw_done[0]);
}

TEST_F(PlacedSession, TheLimitOfTheEntryIsOneOfItsOwn) {
  const double limit_m = PlacedWireRules{}.entry_limit_m;
  EXPECT_TRUE(measures(limit_m - kJust, 0.0).wire->within());
  const Guidance& g = measures(limit_m + kJust, 0.0);
  EXPECT_FALSE(g.wire->within());
  EXPECT_TRUE(g.wire->angle_within());
  EXPECT_EQ(step_of(s.says("next")), "placed L4 left");
}

TEST_F(PlacedSession, AcceptKeepsItBeyondTheLimit) {
  s.says("accept");
  EXPECT_NE(said<NotPossibleNow>(s.pair()), nullptr) << "nothing was measured";
  measures(0.003, 0.0);
  s.says("accept");
  EXPECT_TRUE(s.pair().wire->kept);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kPassed);
  EXPECT_EQ(step_of(s.says("next")), "accepted L4");
  ASSERT_TRUE(level().wires[0].measured);
  EXPECT_TRUE(level().wires[0].measured->kept);
  EXPECT_EQ(level().redone[0], 0);
}

TEST_F(PlacedSession, MeasuredAnewItIsUndecidedAnew) {
  measures(0.003, 0.0);
  s.says("accept");
  EXPECT_FALSE(measures(0.0028, 0.0).wire->kept);
  EXPECT_EQ(step_of(s.says("next")), "placed L4 left");
  EXPECT_TRUE(measures(0.0005, 0.0).wire->within());
  EXPECT_EQ(step_of(s.says("next")), "accepted L4");
}

TEST_F(PlacedSession, NobodyGoesBackToTheHole) {
  measures(0.0025, 0.0);
  s.says("delete");
  const Point<Vertebra> entry = level().plan.screws[0].entry;
  const auto* refusal = said<ReplanRefusal>(s.says("undo"));
  ASSERT_NE(refusal, nullptr);
  EXPECT_EQ(refusal->kind, ReplanRefusal::Kind::kNothingToUndo);
  EXPECT_EQ(level().plan.screws[0].entry, entry);
  EXPECT_TRUE(level().replanned(0)) << "the status line says so";
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
  EXPECT_EQ(step_of(g), "accepted L4");
  ASSERT_NE(said<ScrewRedone>(g), nullptr);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kTouchMore);
  const nav::ScrewPlan& plan = level().plan.screws[0];
  const Point<Vertebra> hole{kLeftEntry + Vec3{0.0025, 0, 0}};
  EXPECT_GE((plan.entry - hole).norm(), PlacedWireRules{}.drill_diameter_m - kJoined);
  EXPECT_NEAR(said<ScrewRedone>(g)->from_hole_m, (plan.entry - hole).norm(), kJoined);
  EXPECT_GT(said<ScrewRedone>(g)->clearance_m, 0.0);
  EXPECT_EQ(plan.target, target);
  EXPECT_NEAR(plan.entry.v.y, 0.020, kExact) << "on the bone's surface";
  EXPECT_FALSE(level().screw_done[0]);
  EXPECT_EQ(level().redone[0], 1);
  EXPECT_TRUE(level().accepted);
  EXPECT_EQ(s.says("next").step, Step::kAccepted) << "the landmark comes first";
  s.touches_dimple();
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left") << "the same screw";
  s.says("next");
  EXPECT_EQ(s.pair().wire, nullptr) << "what was measured is of the wire that is out";
}

TEST_F(PlacedSession, DeleteIsOfAWireBeyondALimitAlone) {
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNothingToDelete);
  measures(0.0005, 0.0);
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNotPossibleNow);
  EXPECT_EQ(step_of(s.pair()), "placed L4 left");
  EXPECT_NE(s.pair().wire, nullptr);
}

TEST_F(PlacedSession, ASecondTimeDeleteMustBeSaidAgain) {
  measures(0.0025, 0.0);
  s.says("delete");
  drill();
  ASSERT_EQ(step_of(s.pair()), "placed L4 left");
  measures(0.0025, 0.0);
  ASSERT_NE(said<ConfirmRedo>(s.says("delete")), nullptr);
  EXPECT_EQ(step_of(s.pair()), "placed L4 left");
  EXPECT_EQ(step_of(s.says("delete")), "accepted L4");
  EXPECT_EQ(level().redone[0], 2);
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
  EXPECT_EQ(step_of(g), "placed L4 left");
  ASSERT_NE(said<NoOtherEntry>(g), nullptr);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kKeepWire);
  EXPECT_EQ(checks_asked(s.pairs(120).status), ChecksAsked::kKeepWire) << "without the message";
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("no other entry stays inside the bone"));
  EXPECT_EQ(level().plan.screws[0].entry.v, kLeftEntry);
  EXPECT_EQ(level().redone[0], 0);
  s.says("accept");
  EXPECT_EQ(step_of(s.says("next")), "accepted L4");
}

TEST_F(PlacedSession, RejectThrowsTheRegistrationAway) {
  measures(0.003, 0.0);
  EXPECT_EQ(step_of(s.says("reject")), "digitize L4");
  EXPECT_FALSE(level().registration);
  EXPECT_FALSE(level().screw_done[0]);
}

TEST_F(PlacedSession, AMapThatMovesTakesTheRegistrationAndTheMeasurement) {
  measures(0.0005, 0.0);
  ++s.map_epoch;
  const Guidance& g = s.pair();
  EXPECT_EQ(step_of(g), "digitize L4");
  EXPECT_EQ(g.wire, nullptr);
  EXPECT_FALSE(level().registration);
}

TEST_F(PlacedSession, TheLastScrewOfALevelGoesOnToTheNextLevel) {
  s.says("next");
  s.touches_dimple();
  s.says("next");
  ASSERT_EQ(step_of(s.says("next")), "placed L4 right");
  EXPECT_EQ(step_of(s.says("next")), "digitize L5");
}

TEST_F(PlacedSession, APlanIsChangedToSuitTheWire) {
  // +x is left of the patient, so lateral of a left screw.
  ASSERT_FALSE(measures(0.0025, 0.0).wire->within());
  const Guidance& g = s.says("move lateral two");
  ASSERT_NE(said<ScrewReplanned>(g), nullptr);
  EXPECT_EQ(step_of(g), "placed L4 left");
  EXPECT_NEAR(level().plan.screws[0].entry.v.x, kLeftEntry.x + 0.002, 1e-4);
  ASSERT_NE(s.pair().wire, nullptr);
  EXPECT_NEAR(s.pair().wire->axis.entry_m.value, 0.0005, 1e-4);
  EXPECT_TRUE(s.pair().wire->within());
  EXPECT_TRUE(level().replanned(0));
  EXPECT_EQ(step_of(s.says("next")), "accepted L4");
  EXPECT_TRUE(level().executed[0]) << "where the tool went is not forgotten";
}

TEST_F(PlacedSession, APlanThatSuitsItLessStillWaitsForAWord) {
  measures(0.0025, 0.0);
  s.says("move medial two");
  EXPECT_NEAR(s.pair().wire->axis.entry_m.value, 0.0045, 1e-4);
  EXPECT_EQ(step_of(s.says("next")), "placed L4 left");
  EXPECT_EQ(step_of(s.says("delete")), "accepted L4");
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

// What does not count as a measurement.

TEST_F(PlacedSession, AGuideThatIsNotSeenMeasuresNothing) {
  set_over(0.0, 0.0);
  s.does({kPress});
  s.tracker().guide.reset();
  s.pair();
  set_over(0.0, 0.0);
  EXPECT_EQ(touch_refusal(s.does({kRelease, kClick})).kind, Kind::kGuideNotSeen);
  EXPECT_EQ(said<TouchNotRecorded>(s.pair())->what, TouchNotRecorded::What::kWire);
  EXPECT_EQ(s.pair().wire, nullptr);
  s.tracker().guide_origin = PoseStatus::kPredicted;
  EXPECT_EQ(touch_refusal(measures(0.0, 0.0)).kind, Kind::kGuideNotSeen);
  s.tracker().guide_origin = PoseStatus::kMeasured;
  EXPECT_NE(measures(0.0, 0.0).wire, nullptr) << "the twin";
}

TEST_F(PlacedSession, AStalePoseMeasuresNothing) {
  set_over(0.0, 0.0);
  s.does({kPress});
  s.pair();
  s.tracker().guide.reset();
  s.pairs(5);
  EXPECT_EQ(touch_refusal(s.does({kRelease, kClick})).kind, Kind::kGuideNotSeen);
}

TEST_F(PlacedSession, ASleeveThatMovesMeasuresNothing) {
  set_over(0.0, 0.0);
  s.does({kPress});
  s.pair();
  set_over(0.0, 0.08);
  s.pair();
  EXPECT_EQ(touch_refusal(s.does({kRelease, kClick})).kind, Kind::kSleeveTurned);
  set_over(0.0, 0.0);
  s.does({kPress});
  s.pair();
  set_over(0.010, 0.0);
  s.pair();
  EXPECT_EQ(touch_refusal(s.does({kRelease, kClick})).kind, Kind::kTipMoved);
  EXPECT_EQ(touch_refusal(s.does({kClick})).kind, Kind::kPressAgain);
  s.does({kPress});
  EXPECT_EQ(touch_refusal(s.does({kHold})).kind, Kind::kHeldTooLong);
  EXPECT_EQ(said<TouchNotRecorded>(s.pair())->what, TouchNotRecorded::What::kWire);
}

TEST_F(PlacedSession, ASleeveElsewhereIsNotOverThisWire) {
  const TouchRefusal off = touch_refusal(measures(0.0151, 0.0));
  EXPECT_EQ(off.kind, Kind::kOffTheScrew);
  EXPECT_NEAR(off.value_m, 0.0151, kJoined);
  EXPECT_EQ(touch_refusal(measures(0.0, 31.0 * kRadiansPerDegree)).kind, Kind::kAcrossTheScrew);
  EXPECT_NE(measures(0.0149, 29.0 * kRadiansPerDegree).wire, nullptr) << "the twin";
}

TEST_F(PlacedSession, ARefusedMeasurementLeavesTheOneBefore) {
  measures(0.0007, 0.0);
  touch_refusal(measures(0.03, 0.0));
  ASSERT_NE(s.pair().wire, nullptr);
  EXPECT_NEAR(s.pair().wire->axis.entry_m.value, 0.0007, kJoined);
}

class UnsureRegistration : public PlacedSession {
 protected:
  UnsureRegistration() : PlacedSession(options(), false) {}
  static SessionOptions options() {
    SessionOptions options;
    options.placed.most_entry_sd_m = 0.0004;
    return options;
  }
};

TEST_F(UnsureRegistration, AMeasurementThatSaysTooLittleIsRefusedWithItsSd) {
  const TouchRefusal why = touch_refusal(measures(0.0, 0.0));
  EXPECT_EQ(why.kind, Kind::kEntryUnsure);
  EXPECT_GT(why.value_m, 0.0004);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("place known to ± 0.9 mm, limit 0.4 mm"));
}

class UnknownRegistration : public PlacedSession {
 protected:
  UnknownRegistration() : PlacedSession({}, false, 0.0) {}
};

TEST_F(UnknownRegistration, WithoutASdNothingIsMeasured) {
  EXPECT_EQ(touch_refusal(measures(0.0, 0.0)).kind, Kind::kEntryUnsure);
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("not known"));
  EXPECT_EQ(step_of(s.says("next")), "accepted L4");
}

class LooseAxis : public PlacedSession {
 protected:
  LooseAxis() : PlacedSession(options()) {}
  static SessionOptions options() {
    SessionOptions options;
    options.placed.axis_sd_rad = 0.03;
    return options;
  }
};

TEST_F(LooseAxis, AnAxisThatIsHardlyCalibratedMeasuresNoAngle) {
  EXPECT_EQ(touch_refusal(measures(0.0, 0.0, 0.0)).kind, Kind::kAngleUnsure);
}

class AnchoredPlaced : public PlacedSession {
 protected:
  AnchoredPlaced() : PlacedSession(test::three_places(), true) {}
};

TEST_F(AnchoredPlaced, MeasuresRelativeToTheReferenceAndNotWithoutIt) {
  EXPECT_NE(measures(0.0005, 0.0).wire, nullptr);
  s.says("next");
  drill();
  s.tracker().reference_seen = false;
  s.pairs(5);
  EXPECT_EQ(touch_refusal(measures(0.0005, 0.0)).kind, Kind::kReferenceNotSeen);
}

TEST_F(AnchoredPlaced, AReferenceThatMovedTakesTheRegistration) {
  measures(0.0005, 0.0);
  ++s.tracker().reference.moves;
  EXPECT_EQ(step_of(s.pair()), "digitize L4");
  EXPECT_EQ(s.pair().wire, nullptr);
}

TEST(PlacedWireRules, NameWhatMakesNoSense) {
  EXPECT_TRUE(PlacedWireRules{}.check().empty());
  SessionOptions bad;
  bad.placed.angle_limit_rad = 0.0;
  bad.placed.most_entry_sd_m = std::nan("");
  bad.placed.axis_sd_rad = -0.1;
  EXPECT_EQ(bad.check().size(), 3U);
}

TEST(ByEye, NothingIsAskedOfTheWire) {
  ScriptedOperation s({"L4"});
  s.accepts_first_level();
  s.says("next");
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
  EXPECT_FALSE(s.session().levels()[0].wires[0].asked);
}

}  // namespace
}  // namespace orthonav::engine::session_placed_test
