#include <gmock/gmock.h>

#include <cmath>

#include "engine/session/session.h"
#include "engine/session/text/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_landmark_test {
namespace {

using test::notice_of;
using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using test::touch_refusal;
using enum ClickerAction;

// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;
constexpr Vec3 kLandmark = ScriptedOperation::kLandmark;
/// Two touches of a few pairs each are so imprecise that the limit is at its maximum.
constexpr double kLimit_m = kMaxLandmarkOff_m;
constexpr double kJust_m = 1e-5;

/// In `landmark`, with a registration that puts the box where it is: World is Vertebra.
class LandmarkSession : public ::testing::Test {
 protected:
  LandmarkSession() : s({"L4", "L5"}, {}, Verification::kByTouch) { s.accepts_first_by_touch(); }
  const LevelState& level() { return s.session().levels()[0]; }
  void finish_first_screw() {
    s.touches_landmark();
    s.says("next");
    s.says("next");
    s.says("next");
  }
  ScriptedOperation s;
};

TEST_F(LandmarkSession, NothingIsGuidedBeforeTheLandmarkIsRecorded) {
  EXPECT_EQ(step_of(s.pair()), "landmark L4");
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kTouchMore);
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark);
  ASSERT_NE(said<LandmarkMissing>(s.pair()), nullptr);
  EXPECT_FALSE(said<LandmarkMissing>(s.pair())->recorded);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kTouchMore) << "in a message as well";
  const Guidance& g = s.touches_landmark();
  ASSERT_NE(state<LandmarkSoFar>(g), nullptr);
  EXPECT_TRUE(state<LandmarkSoFar>(g)->last->first);
  EXPECT_EQ(checks_asked(g.status), ChecksAsked::kGuideTip);
  ASSERT_TRUE(level().landmark);
  EXPECT_NEAR((level().landmark->in_vertebra.v - kLandmark).norm(), 0.0, kExact);
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left");
}

TEST_F(LandmarkSession, OnTheMapOneTouchAloneSaysNothing) {
  s.touches(kLandmark);
  EXPECT_EQ(state<LandmarkSoFar>(s.pair())->last->missing, 1);
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kTouchMore);
  EXPECT_FALSE(level().landmark);
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark);
  s.touches(kLandmark + Vec3{0.001, 0, 0});
  ASSERT_TRUE(level().landmark);
  EXPECT_NEAR((level().landmark->in_vertebra.v - kLandmark).norm(), 0.0005, kExact) << "the mean";
  EXPECT_EQ(s.says("next").step, Step::kGuide);
}

TEST_F(LandmarkSession, TouchesThatLieApartAreNotOfOneLandmark) {
  s.touches(kLandmark);
  const TouchRefusal why = touch_refusal(s.touches(kLandmark + Vec3{0.006, 0, 0}));
  EXPECT_EQ(why.kind, TouchRefusal::Kind::kTouchesApart);
  EXPECT_NEAR(why.value_m, 0.006, kExact);
  EXPECT_LT(why.limit_m, 0.003);
  s.touches(kLandmark);
  EXPECT_FALSE(level().landmark) << "it begins anew";
  s.touches(kLandmark + Vec3{0.002, 0, 0});
  EXPECT_TRUE(level().landmark) << "the twin";
}

TEST_F(LandmarkSession, IsTouchedAgainAfterEveryScrew) {
  finish_first_screw();
  EXPECT_EQ(step_of(s.pair()), "landmark L4");
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark) << "the touch before the last screw is past";
  ASSERT_NE(said<LandmarkMissing>(s.pair()), nullptr);
  EXPECT_TRUE(said<LandmarkMissing>(s.pair())->recorded);
  s.touches_landmark(Vec3{0.0009, 0, 0});
  EXPECT_NEAR(state<LandmarkSoFar>(s.pair())->last->off_m, 0.0009, kExact);
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
  s.says("next");
  EXPECT_EQ(step_of(s.says("next")), "digitize L5") << "the last screw of a level needs none";
}

TEST_F(LandmarkSession, OneThatMovedTakesTheAcceptanceBack) {
  finish_first_screw();
  const Guidance& g = s.touches_landmark(Vec3{0, 0, kLimit_m + kJust_m});
  EXPECT_EQ(step_of(g), "verify L4");
  EXPECT_FALSE(level().accepted);
  EXPECT_TRUE(level().check_points.empty());
  EXPECT_TRUE(level().registration) << "it is judged anew";
  ASSERT_NE(said<LandmarkMoved>(g), nullptr);
  EXPECT_NEAR(said<LandmarkMoved>(g)->off_m, kLimit_m + kJust_m, kExact);
  EXPECT_NEAR(said<LandmarkMoved>(g)->limit_m, kLimit_m, kExact);
  EXPECT_FALSE(said<LandmarkMoved>(g)->anchored);
  EXPECT_EQ(s.says("next").step, Step::kVerify);
  EXPECT_EQ(s.says("accept").step, Step::kVerify) << "check points are touched anew";
  EXPECT_TRUE(state<ChecksSoFar>(s.pairs(100))->moved_m) << "and the line goes on saying so";
}

TEST_F(LandmarkSession, TheTwinJustWithinTheLimitIsGuided) {
  finish_first_screw();
  s.touches_landmark(Vec3{0, 0, kLimit_m - kJust_m});
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
}

TEST_F(LandmarkSession, StaysOverAnotherAcceptanceAndMustBeFoundThen) {
  finish_first_screw();
  const Vec3 away{0, 0, 0.0025};
  s.touches_landmark(away);
  s.checks_by_touch();
  s.says("accept");
  ASSERT_EQ(step_of(s.pair()), "landmark L4");
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark);
  EXPECT_EQ(s.touches_landmark(away).step, Step::kVerify) << "the bone is where it was touched";
  s.checks_by_touch();
  s.says("accept");
  s.touches_landmark();
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right") << "a slip of the tip costs three touches";
}

TEST_F(LandmarkSession, WhatIsShownAgainIsNotAcceptedByAnEarlierWord) {
  finish_first_screw();
  const Timestamp before = s.now();
  s.touches_landmark(Vec3{0, 0, 0.003});
  s.checks_by_touch();
  ASSERT_EQ(step_of(s.pair()), "verify L4");
  s.hears_at(before, "accept");
  EXPECT_EQ(notice_of(s.pair()), Notice::kSaidTooEarly);
  EXPECT_EQ(s.says("accept").step, Step::kTouchLandmark) << "the twin, said now";
}

TEST_F(LandmarkSession, DeleteTakesTheLastTouchBack) {
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNothingToDelete);
  s.touches_landmark();
  s.says("delete");
  EXPECT_FALSE(level().landmark) << "the first touch was the landmark";
  finish_first_screw();
  s.touches_landmark(Vec3{0.001, 0, 0});
  s.says("delete");
  ASSERT_TRUE(level().landmark);
  EXPECT_NEAR((level().landmark->in_vertebra.v - kLandmark).norm(), 0.0, kExact);
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark);
}

TEST_F(LandmarkSession, IsForgottenWithItsRegistration) {
  finish_first_screw();
  s.says("reject");
  EXPECT_FALSE(level().landmark);
}

TEST_F(LandmarkSession, IsForgottenWithTheMap) {
  s.touches_landmark();
  ++s.map_epoch;
  s.pair();
  EXPECT_FALSE(level().landmark);
}

TEST_F(LandmarkSession, ATouchThatDoesNotCountRecordsNothing) {
  s.tracker().pointer = pointer_at(kLandmark);
  s.does({kPress});
  EXPECT_EQ(touch_refusal(s.does({kHold})).kind, TouchRefusal::Kind::kHeldTooLong);
  EXPECT_EQ(said<TouchNotRecorded>(s.pair())->what, TouchNotRecorded::What::kLandmark);
  s.does({kRelease});
  s.does({kPress});
  s.tracker().pointer = pointer_at(kLandmark + Vec3{0.0064, 0, 0});
  s.pair();
  EXPECT_EQ(touch_refusal(s.does({kRelease, kClick})).kind, TouchRefusal::Kind::kTipMoved);
  EXPECT_EQ(touch_refusal(s.does({kClick})).kind, TouchRefusal::Kind::kPressAgain);
  EXPECT_FALSE(level().landmark);
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark);
}

TEST_F(LandmarkSession, AskForThePointerWhileItIsNotSeen) {
  s.tracker().pointer.reset();
  EXPECT_TRUE(s.pairs(5).status.tool_lost);
}

TEST_F(LandmarkSession, APressWhileAWireWasLookedAtIsNoTouch) {
  s.touches_landmark();
  s.says("next");
  s.says("next");
  s.does({kPress});
  s.says("next");
  EXPECT_EQ(touch_refusal(s.does({kRelease, kClick})).kind, TouchRefusal::Kind::kPressAgain);
}

/// The reference stands on the box's right, its foot 20 mm from the landmark's side.
class AnchoredLandmark : public ::testing::Test {
 protected:
  AnchoredLandmark() : s({"L4"}, test::three_places(), Verification::kByTouch, false, true) {
    s.tracker().reference_pose = {Mat3::identity(), kFoot + Vec3{0, 0.06, 0}};
    s.accepts_first_by_touch();
  }
  static constexpr Vec3 kFoot{-0.028, 0.020, 0.0};
  ScriptedOperation s;
};

TEST_F(AnchoredLandmark, IsRefusedNearTheReference) {
  const Vec3 near = kFoot + Vec3{0.020, 0, 0};
  const TouchRefusal why = touch_refusal(s.touches(near));
  EXPECT_EQ(why.kind, TouchRefusal::Kind::kTooNear);
  EXPECT_NEAR(why.value_m, 0.020, kExact);
  EXPECT_NEAR(why.limit_m, kLandmarkFromReference_m, kExact);
  EXPECT_FALSE(s.session().levels()[0].landmark);
  s.touches(kFoot + Vec3{0.031, 0, 0});
  EXPECT_TRUE(s.session().levels()[0].landmark);
}

TEST_F(AnchoredLandmark, SaysThatItIsTheReferenceThatMoved) {
  s.touches_landmark();
  s.says("next");
  s.says("next");
  s.says("next");
  const Guidance& g = s.touches_landmark(Vec3{0.002, 0, 0});
  ASSERT_NE(said<LandmarkMoved>(g), nullptr);
  EXPECT_TRUE(said<LandmarkMoved>(g)->anchored);
}

TEST(Landmarking, OfABoneThatDoesNotReachSoFarMayLieNearer) {
  constexpr double kSmaller = 0.6;
  nav::TriangleMesh bone = test::box_bone();
  for (Vec3& vertex : bone.vertices_m) {
    vertex = kSmaller * vertex;
  }
  Landmarking landmarking;
  LevelState level;
  level.plan.model = nav::VertebraModel::prepare(bone).value();
  level.registration = nav::Registration{};
  const std::vector<ReferencePost> posts = {{{{0, 0.08, 0}}, {{0, kSmaller * 0.020, 0}}}};
  // The farthest corner of the box's back, 18 x 15 mm from the foot, or deeper.
  const auto at = [&](double x_m) {
    const Point<World> place{{x_m, kSmaller * 0.020, 0}};
    return landmarking.take(level, nav::PressedPlace{place, 0.0003}, posts, true, {});
  };
  const auto refused = at(0.012);
  ASSERT_TRUE(std::holds_alternative<TouchRefusal>(refused));
  const double limit_m = std::get<TouchRefusal>(refused).limit_m;
  EXPECT_GT(limit_m, kSmaller * 0.030);
  EXPECT_LT(limit_m, kLandmarkReach * kSmaller * std::hypot(0.030, 0.025, 0.040) + kExact);
  EXPECT_TRUE(std::holds_alternative<LandmarkTouch>(at(limit_m + kJust_m)));
}

TEST(Landmark, TheLimitFollowsHowSurelyBothTouchesWereSeen) {
  const double sharp_m = landmark_limit_m(landmark_distance_sd_m(0.0001, 0.0001, true));
  EXPECT_NEAR(sharp_m,
              kLandmarkSds * std::sqrt(2.0 * (1e-8 + kLandmarkSeatingSd_m * kLandmarkSeatingSd_m +
                                              std::pow(kLastingSdAnchored_m, 2))),
              kExact);
  EXPECT_GT(landmark_limit_m(landmark_distance_sd_m(0.0003, 0.0001, true)), sharp_m);
  EXPECT_GT(landmark_limit_m(landmark_distance_sd_m(0.0001, 0.0001, false)), sharp_m);
  EXPECT_EQ(landmark_limit_m(landmark_distance_sd_m(0.01, 0.01, false)), kMaxLandmarkOff_m)
      << "what matters must show";
}

}  // namespace
}  // namespace orthonav::engine::session_landmark_test
