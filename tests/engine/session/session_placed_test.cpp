#include <gmock/gmock.h>

#include <cmath>

#include "base/angle.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/placed_session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_placed_test {
namespace {

using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using ::testing::HasSubstr;

constexpr double kJust = 5e-5;

TEST_F(PlacedSession, FollowsEveryScrewAndAsksForTheSleeve) {
  const Guidance& g = s.pair();
  EXPECT_EQ(step_of(g), "measure L4 left");
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kRecordWire);
  EXPECT_EQ(g.status.tool, "guide");
  EXPECT_EQ(g.wire, nullptr);
  EXPECT_FALSE(g.tool) << "nothing is guided";
  EXPECT_THAT(detail_text(g.status), HasSubstr("sleeve over wire, turn, click"));
}

TEST_F(PlacedSession, AWireWithinTheLimitsIsTold) {
  const Guidance& g = measures(0.0006, 0.8 * kRadiansPerDegree);
  ASSERT_NE(state<WireSoFar>(g), nullptr);
  ASSERT_NE(state<WireSoFar>(g)->wire, nullptr);
  const PlacedWire& wire = *state<WireSoFar>(g)->wire;
  EXPECT_NEAR(wire.axis.angle_rad.value, 0.8 * kRadiansPerDegree, kJoined);
  EXPECT_NEAR(wire.axis.entry_m.value, 0.0006, kJoined);
  EXPECT_TRUE(wire.within());
  EXPECT_EQ(g.wire, &wire);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kPassed);
  EXPECT_THAT(detail_text(g.status), HasSubstr("say go to next"));
  EXPECT_EQ(step_of(s.says("next")), "landmark L4") << "the landmark before the other screw";
  EXPECT_TRUE(level().screws[0].done);
  ASSERT_TRUE(level().screws[0].wire.measured);
  EXPECT_FALSE(level().screws[0].wire.measured->kept);
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

TEST_F(PlacedSession, NextBeforeAnythingWasMeasuredGoesOnAndIsKnown) {
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
  EXPECT_TRUE(level().screws[0].done);
  EXPECT_TRUE(level().screws[0].wire.asked);
  EXPECT_FALSE(level().screws[0].wire.measured);
}

TEST_F(PlacedSession, BeyondALimitNextIsNotTakenBeforeAWord) {
  const double limit_rad = PlacedWireRules{}.angle_limit_rad;
  EXPECT_TRUE(measures(0.0, limit_rad - kJust).wire->within());
  const Guidance& g = measures(0.0, limit_rad + kJust);
  EXPECT_FALSE(g.wire->within());
  EXPECT_TRUE(g.wire->entry_within());
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kDecideOnWire);
  EXPECT_THAT(detail_text(g.status), HasSubstr("limit 2.00"));
  EXPECT_EQ(step_of(s.says("next")), "measure L4 left");
  EXPECT_NE(said<WireUndecided>(s.pair()), nullptr);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kDecideOnWire) << "in a message as well";
  EXPECT_FALSE(level().screws[0].done);
}

TEST_F(PlacedSession, TheLimitOfTheEntryIsOneOfItsOwn) {
  const double limit_m = PlacedWireRules{}.entry_limit_m;
  EXPECT_TRUE(measures(limit_m - kJust, 0.0).wire->within());
  const Guidance& g = measures(limit_m + kJust, 0.0);
  EXPECT_FALSE(g.wire->within());
  EXPECT_TRUE(g.wire->angle_within());
  EXPECT_EQ(step_of(s.says("next")), "measure L4 left");
}

TEST_F(PlacedSession, AcceptKeepsItBeyondTheLimit) {
  s.says("accept");
  EXPECT_NE(said<NotPossibleNow>(s.pair()), nullptr) << "nothing was measured";
  measures(0.003, 0.0);
  s.says("accept");
  EXPECT_TRUE(s.pair().wire->kept);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kPassed);
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
  ASSERT_TRUE(level().screws[0].wire.measured);
  EXPECT_TRUE(level().screws[0].wire.measured->kept);
  EXPECT_EQ(level().screws[0].redone, 0);
}

TEST_F(PlacedSession, MeasuredAnewItIsUndecidedAnew) {
  measures(0.003, 0.0);
  s.says("accept");
  EXPECT_FALSE(measures(0.0028, 0.0).wire->kept);
  EXPECT_EQ(step_of(s.says("next")), "measure L4 left");
  EXPECT_TRUE(measures(0.0005, 0.0).wire->within());
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
}

TEST_F(PlacedSession, RejectThrowsTheRegistrationAway) {
  measures(0.003, 0.0);
  EXPECT_EQ(step_of(s.says("reject")), "digitize L4");
  EXPECT_FALSE(level().registration);
  EXPECT_FALSE(level().screws[0].done);
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
  s.touches_landmark();
  s.says("next");
  ASSERT_EQ(step_of(s.says("next")), "measure L4 right");
  EXPECT_EQ(step_of(s.says("next")), "digitize L5");
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
  EXPECT_FALSE(s.session().levels()[0].screws[0].wire.asked);
}

}  // namespace
}  // namespace orthonav::engine::session_placed_test
