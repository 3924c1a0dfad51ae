#include <gmock/gmock.h>

#include "engine/session/session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_checks_test {
namespace {

using test::advice;
using test::notice_of;
using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using test::touch_refusal;
using enum ClickerAction;
using ::testing::HasSubstr;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;
// On the box's posterior face (y = 20 mm), more than 15 mm apart and not on a line.
constexpr Vec3 kFirst{-0.015, 0.020, -0.010};
constexpr Vec3 kSecond{0.015, 0.020, -0.010};
constexpr Vec3 kThird{0.000, 0.020, 0.012};

/// Whether the advice asks for this many places, apart from each other.
bool asks_for(const nav::CheckAdvice& advice, std::size_t places) {
  return advice.kind == nav::CheckAdvice::Kind::kTouchApart && advice.number == places;
}

/// In `verify`, with a registration that puts the box where it is: World is Vertebra.
class CheckedSession : public ::testing::Test {
 protected:
  CheckedSession() : s({"L4", "L5"}, {}, Verification::kByTouch) { s.registers_first_level(); }
  const std::vector<nav::CheckPoint>& points() { return s.session().levels()[0].check_points; }
  ScriptedOperation s;
};

TEST_F(CheckedSession, AcceptsOnceThreeSpreadPlacesLieOnTheSurface) {
  EXPECT_TRUE(asks_for(advice(s.pair()), 3));
  EXPECT_EQ(step_of(s.says("accept")), "verify L4");
  ASSERT_NE(said<ChecksMissing>(s.pair()), nullptr);
  EXPECT_TRUE(asks_for(said<ChecksMissing>(s.pair())->advice, 3));
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kTouchMore);
  EXPECT_TRUE(asks_for(advice(s.touches(kFirst)), 2));
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  EXPECT_TRUE(asks_for(advice(s.touches(kSecond)), 1));
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  EXPECT_EQ(checks_asked(s.touches(kThird).status), ChecksAsked::kPassed);
  EXPECT_FALSE(s.pair().levels[0].accepted) << "the word is still theirs";
  EXPECT_EQ(step_of(s.says("accept")), "landmark L4");
  EXPECT_TRUE(s.pair().levels[0].accepted);
}

TEST_F(CheckedSession, RecordsTheSignedDistanceFromTheSurface) {
  s.touches(kFirst + Vec3{0, 0.0012, 0});
  s.touches(kSecond - Vec3{0, 0.0007, 0});
  ASSERT_EQ(points().size(), 2u);
  EXPECT_NEAR(points()[0].distance_m, 0.0012, kExact);
  EXPECT_NEAR(points()[1].distance_m, -0.0007, kExact);
  EXPECT_NEAR((points()[0].place.v - kFirst).norm(), 0.0012, kExact);
  ASSERT_NE(state<ChecksSoFar>(s.pair()), nullptr);
}

TEST_F(CheckedSession, AcceptsNothingWithAPlaceTooFarOff) {
  s.touches(kFirst);
  s.touches(kSecond + Vec3{0, 0.0031, 0});
  s.touches(kThird);
  const nav::CheckAdvice why = advice(s.pair());
  EXPECT_EQ(why.kind, nav::CheckAdvice::Kind::kReject);
  EXPECT_EQ(why.number, 2u);
  EXPECT_NEAR(why.value_m, 0.0031, kExact);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kReject);
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  ASSERT_NE(said<ChecksMissing>(s.pair()), nullptr);
  EXPECT_EQ(said<ChecksMissing>(s.pair())->advice.kind, nav::CheckAdvice::Kind::kReject);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kReject) << "in a message as well";
  // The counterpart: just within the limit.
  ScriptedOperation near({"L4"}, {}, Verification::kByTouch);
  near.registers_first_level();
  near.touches(kFirst);
  near.touches(kSecond + Vec3{0, 0.0019, 0});
  near.touches(kThird);
  EXPECT_EQ(near.says("accept").step, Step::kTouchLandmark);
}

TEST_F(CheckedSession, TheSamePlaceThreeTimesIsOnePlace) {
  for (int i = 0; i < 3; ++i) {
    s.touches(kFirst + Vec3{0.001 * i, 0, 0});
  }
  EXPECT_TRUE(asks_for(advice(s.pair()), 2));
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
}

TEST_F(CheckedSession, DeleteDropsTheLastCheckPoint) {
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNothingToDelete);
  s.touches(kFirst);
  s.touches(kSecond + Vec3{0, 0.0031, 0});
  s.says("delete");
  ASSERT_EQ(points().size(), 1u);
  EXPECT_NEAR((points()[0].place.v - kFirst).norm(), 0.0, kExact);
}

TEST_F(CheckedSession, RejectForgetsThemAndTheNextRegistrationStartsWithNone) {
  s.touches(kFirst);
  s.says("reject");
  EXPECT_TRUE(points().empty());
  s.strokes(5);
  s.says("save");
  EXPECT_EQ(s.does({kDoubleClick}).step, Step::kVerify);
  EXPECT_TRUE(points().empty());
}

TEST_F(CheckedSession, AButtonHeldTooLongOrATipThatMovesRecordsNothing) {
  s.tracker().pointer = pointer_at(kFirst);
  s.does({kPress});
  EXPECT_EQ(touch_refusal(s.does({kHold})).kind, TouchRefusal::Kind::kHeldTooLong);
  s.does({kRelease});
  EXPECT_TRUE(points().empty());
  s.does({kPress});
  s.tracker().pointer = pointer_at(kFirst + Vec3{0.0064, 0, 0});
  s.pair();
  EXPECT_EQ(touch_refusal(s.does({kRelease, kClick})).kind, TouchRefusal::Kind::kTipMoved);
  EXPECT_TRUE(points().empty());
  EXPECT_EQ(s.touches(kFirst).levels[0].check_points.size(), 1u) << "the next starts anew";
}

TEST_F(CheckedSession, RecordsNothingOfAPointerThatIsNotSeen) {
  s.tracker().pointer.reset();
  s.pairs(5);
  const Guidance& g = s.does({kPress, kRelease, kClick});
  EXPECT_TRUE(points().empty());
  EXPECT_TRUE(g.status.tool_lost);
  EXPECT_EQ(touch_refusal(g).kind, TouchRefusal::Kind::kPointerNotSeen);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kNone) << "while the message stands";
  EXPECT_TRUE(s.pairs(100).status.tool_lost);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kTouchMore);
}

TEST_F(CheckedSession, APressFromTheStrokesIsNoTouch) {
  EXPECT_EQ(touch_refusal(s.does({kClick})).kind, TouchRefusal::Kind::kPressAgain);
  EXPECT_TRUE(points().empty());
}

TEST_F(CheckedSession, StopsCountingAtTheMost) {
  for (std::size_t i = 0; i < nav::kMaxCheckPoints; ++i) {
    s.touches(kFirst);
  }
  EXPECT_EQ(touch_refusal(s.touches(kFirst)).kind, TouchRefusal::Kind::kTooMany);
  EXPECT_EQ(points().size(), nav::kMaxCheckPoints);
}

TEST_F(CheckedSession, ShowsThemWhileVerifyingOnly) {
  s.touches(kFirst);
  s.touches(kSecond);
  s.touches(kThird);
  EXPECT_EQ(s.pair().levels[0].check_points.size(), 3u);
  EXPECT_EQ(s.says("accept").levels[0].check_points.size(), 3u) << "they stay for the report";
}

/// Soft tissue left an uncertainty of 1.5 mm in the depth of the box, which touches on its back
/// resolve.
nav::Registration provisional() {
  nav::Registration r;
  r.provisional = true;
  r.reasons = {{nav::RefusalReason::Kind::kTre99AtScrews, 0.0039, 0.002}};
  r.rmse_m = 0.0012;
  r.points = 300;
  std::array<double, 36> covariance{};
  covariance[0] = covariance[14] = 1e-8;
  covariance[7] = 0.0015 * 0.0015;
  covariance[21] = covariance[28] = covariance[35] = 1e-8;
  r.uncertainty = nav::PoseUncertainty({}, covariance);
  r.tre_99_m = 0.0039;
  return r;
}

TEST(ProvisionalRegistration, CountsOnceTheBoneWasTouched) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registration = provisional();
  s.registers_first_level();
  EXPECT_EQ(step_of(s.pair()), "verify L4");
  EXPECT_EQ(s.says("accept").step, Step::kVerify) << "it has not been touched";
  // The bone lies 1.2 mm deeper than the strokes showed.
  const Vec3 deeper{0, -0.0012, 0};
  s.touches(kFirst + deeper);
  const double shown_m = s.pair().levels[0].registration->world_from_vertebra.translation().y;
  EXPECT_NEAR(shown_m, -0.0013, 0.0002) << "the picture follows what is touched";
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  s.touches(kSecond + deeper);
  EXPECT_EQ(checks_asked(s.touches(kThird + deeper).status), ChecksAsked::kPassed);
  EXPECT_EQ(step_of(s.says("accept")), "landmark L4");
  const nav::Registration& r = *s.session().levels()[0].registration;
  EXPECT_TRUE(r.accepted);
  EXPECT_NEAR(r.world_from_vertebra.translation().y, -0.0013, 0.0001)
      << "0.2 mm under the tip, less what strokes and the model's own error keep";
  EXPECT_LT(r.tre_99_m, 0.002);
}

TEST(ProvisionalRegistration, AsksForMorePlacesAndTakesOneBackAsIfItHadNotBeen) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registration = provisional();
  // The uncertainty is a slide along the back, which no place on it can resolve.
  std::array<double, 36> covariance = s.registration.uncertainty->covariance();
  covariance[0] = 0.0015 * 0.0015;
  s.registration.uncertainty = nav::PoseUncertainty({}, covariance);
  s.registers_first_level();
  for (const Vec3 place : {kFirst, kSecond, kThird}) {
    s.touches(place);
  }
  EXPECT_EQ(advice(s.pair()).kind, nav::CheckAdvice::Kind::kTouchMore);
  EXPECT_GT(advice(s.pair()).value_m, 0.002);
  const auto three = s.pair().levels[0].registration->world_from_vertebra;
  s.touches(kFirst + Vec3{0.004, 0.0, 0.004});
  s.says("delete");
  EXPECT_EQ(s.pair().levels[0].registration->world_from_vertebra, three);
  while (s.pair().levels[0].check_points.size() < nav::kMaxCheckPoints) {
    s.touches(kThird);
  }
  EXPECT_EQ(advice(s.pair()).kind, nav::CheckAdvice::Kind::kUncertain);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kReject);
}

/// Touched deeper than the strokes showed, rejected, and registered again as before.
double depth_shown_again_m(bool uncertain) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch, false, true);
  s.registration = provisional();
  std::array<double, 36> covariance = s.registration.uncertainty->covariance();
  covariance[0] = 0.0015 * 0.0015;
  s.registration.uncertainty = nav::PoseUncertainty({}, covariance);
  s.registers_first_level();
  const Vec3 deeper{0, -0.0012, 0};
  for (std::size_t k = 0; k < (uncertain ? nav::kMaxCheckPoints : 3); ++k) {
    s.touches(std::array{kFirst, kSecond, kThird}[k % 3] + deeper);
  }
  EXPECT_EQ(advice(s.pair()).kind == nav::CheckAdvice::Kind::kUncertain, uncertain);
  s.says("reject level");
  s.registers_first_level();
  EXPECT_EQ(step_of(s.pair()), "verify L4");
  EXPECT_TRUE(s.pair().levels[0].check_points.empty());
  return s.pair().levels[0].registration->world_from_vertebra.translation().y;
}

TEST(ManyTouches, CountAgainWhereOnlyTheErrorAtTheScrewsSpokeAgainstThem) {
  EXPECT_LT(depth_shown_again_m(true), -0.001);
  EXPECT_EQ(depth_shown_again_m(false), 0.0) << "the twin: rejected for a reason of the surgeon's";
}

TEST(ManyTouches, AreAskedForAsLongAsTheyTell) {
  SessionOptions options;
  options.check_points.enough = 12;
  ScriptedOperation s({"L4"}, options, Verification::kByTouch, false, true);
  s.registers_within(0.0004);
  s.registers_first_level();
  for (const Vec3 place : {kFirst, kSecond, kThird}) {
    s.touches(place);
  }
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kTouchMore);
  EXPECT_EQ(advice(s.pair()).kind, nav::CheckAdvice::Kind::kTouchMore);
  EXPECT_DOUBLE_EQ(advice(s.pair()).limit_m, nav::CheckPointRules{}.wanted_tre_99_m);
  EXPECT_EQ(s.says("accept").step, Step::kVerify);
  for (int k = 0; k < 9; ++k) {
    s.touches(kFirst + Vec3{0.006 * (k % 3 + 1), 0.0, 0.006 * (k / 3)});
  }
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kPassed);
  EXPECT_EQ(step_of(s.says("accept")), "landmark L4");
}

TEST(ManyTouches, AreNotAskedForOnTheMap) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registers_within(0.0004);
  s.registers_first_level();
  for (const Vec3 place : {kFirst, kSecond, kThird}) {
    s.touches(place);
  }
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kPassed);
}

TEST(ProvisionalRegistration, IsRefusedWhereNobodyTouches) {
  ScriptedOperation s({"L4"}, {}, Verification::kByEye);
  s.registration = provisional();
  EXPECT_EQ(s.registers_first_level().step, Step::kDigitize);
  EXPECT_NE(said<RegistrationRefused>(s.pair()), nullptr);
}

TEST(VerifiedByEye, ClicksSayNothingAndTheWordAccepts) {
  ScriptedOperation s({"L4"}, {}, Verification::kByEye);
  s.registers_first_level();
  EXPECT_NE(state<ByEye>(s.touches(kFirst)), nullptr);
  EXPECT_TRUE(s.session().levels()[0].check_points.empty());
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNotPossibleNow);
  s.tracker().pointer.reset();
  EXPECT_FALSE(s.pairs(100).status.tool_lost) << "no tool is in use";
  EXPECT_EQ(s.says("accept").step, Step::kTouchLandmark);
}

TEST(SessionOptions, NamesLimitsOfCheckPointsThatMakeNoSense) {
  SessionOptions bad;
  bad.check_points = {.apart_m = 0.0, .within_m = 0.01, .off_line_m = -1.0};
  EXPECT_EQ(bad.check().size(), 3u);
}

}  // namespace
}  // namespace orthonav::engine::session_checks_test
