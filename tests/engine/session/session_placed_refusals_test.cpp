// What does not count as a measurement of a wire.
#include <gmock/gmock.h>

#include "base/angle.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/placed_session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_placed_test {
namespace {

using test::said;
using test::step_of;
using test::touch_refusal;
using ::testing::HasSubstr;
using enum ClickerAction;
using Kind = TouchRefusal::Kind;

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
  EXPECT_THAT(detail_text(s.pair().status), HasSubstr("uncertainty unknown"));
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
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

}  // namespace
}  // namespace orthonav::engine::session_placed_test
