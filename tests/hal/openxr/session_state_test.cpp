#include "hal/openxr/session_state.h"

#include <gtest/gtest.h>

namespace orthonav::openxr {
namespace {

/// Takes states one after the other; returns what the last one asks for.
SessionDuty after(SessionState& state, std::initializer_list<XrSessionState> states) {
  SessionDuty duty = SessionDuty::kNone;
  for (const XrSessionState next : states) {
    duty = state.take(next);
  }
  return duty;
}

TEST(SessionState, BeginsOnceReadyAndIsFocusedLater) {
  SessionState state;
  EXPECT_EQ(after(state, {XR_SESSION_STATE_IDLE}), SessionDuty::kNone);
  EXPECT_FALSE(state.running());
  EXPECT_EQ(after(state, {XR_SESSION_STATE_READY}), SessionDuty::kBegin);
  EXPECT_TRUE(state.running());
  EXPECT_EQ(after(state, {XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE}),
            SessionDuty::kNone);
  EXPECT_FALSE(state.focused());
  EXPECT_EQ(after(state, {XR_SESSION_STATE_FOCUSED}), SessionDuty::kNone);
  EXPECT_TRUE(state.focused());
  EXPECT_EQ(after(state, {XR_SESSION_STATE_VISIBLE}), SessionDuty::kNone);
  EXPECT_FALSE(state.focused());
  EXPECT_TRUE(state.running());
}

TEST(SessionState, EndsWhenStoppingAndBeginsAgain) {
  SessionState state;
  after(state, {XR_SESSION_STATE_READY, XR_SESSION_STATE_FOCUSED});
  EXPECT_EQ(after(state, {XR_SESSION_STATE_STOPPING}), SessionDuty::kEnd);
  EXPECT_FALSE(state.running());
  EXPECT_EQ(after(state, {XR_SESSION_STATE_IDLE}), SessionDuty::kNone);
  EXPECT_EQ(after(state, {XR_SESSION_STATE_READY}), SessionDuty::kBegin);
}

TEST(SessionState, AsksNothingTwice) {
  SessionState state;
  EXPECT_EQ(after(state, {XR_SESSION_STATE_STOPPING}), SessionDuty::kNone);
  after(state, {XR_SESSION_STATE_READY});
  EXPECT_EQ(after(state, {XR_SESSION_STATE_READY}), SessionDuty::kNone);
}

TEST(SessionState, TellsALossFromAnEnd) {
  SessionState lost;
  after(lost, {XR_SESSION_STATE_READY});
  EXPECT_EQ(after(lost, {XR_SESSION_STATE_LOSS_PENDING}), SessionDuty::kRestart);
  EXPECT_FALSE(lost.running());
  SessionState left;
  EXPECT_EQ(after(left, {XR_SESSION_STATE_READY, XR_SESSION_STATE_STOPPING, XR_SESSION_STATE_IDLE,
                         XR_SESSION_STATE_EXITING}),
            SessionDuty::kLeave);
}

TEST(SessionState, IgnoresWhatItDoesNotKnow) {
  SessionState state;
  after(state, {XR_SESSION_STATE_READY});
  EXPECT_EQ(state.take(static_cast<XrSessionState>(4711)), SessionDuty::kNone);
  EXPECT_TRUE(state.running());
}

}  // namespace
}  // namespace orthonav::openxr
