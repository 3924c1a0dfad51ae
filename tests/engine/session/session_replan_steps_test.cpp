// In which steps a screw may be changed in surgery.
#include <gmock/gmock.h>

#include "engine/session/text/wording.h"
#include "tests/engine/session/replan_session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_replan_test {
namespace {

using test::notice_of;
using test::said;
using test::step_of;
using ::testing::HasSubstr;

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
  EXPECT_EQ(s.level().screws[0].earlier_plans.size(), 1u);
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
  s.touches_landmark();
  s.says("next");
  s.says("next");
  s.says("next");  // its wire is not measured
  ASSERT_EQ(step_of(s.pair()), "landmark L4");
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
    EXPECT_THAT(detail_text(g.status), HasSubstr("; touch a new landmark"));
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

TEST(SessionReplanSteps, ChangesOutliveTheRegistration) {
  Replan4 s;
  s.guides_left();
  s.says("move cranial one");
  s.says("reject");
  EXPECT_NEAR(s.left().entry.v.z, kMm, kExact) << "they are of the bone";
  EXPECT_TRUE(s.level().screws[0].replanned());
}

}  // namespace
}  // namespace orthonav::engine::session_replan_test
