// The button: a controller's select, or a pinch.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/openxr/runtime_test.h"

namespace orthonav::test::select_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Action = ClickerAction;

class SelectTest : public RuntimeTest {
 protected:
  void begin(RuntimeTraits traits, fake::Script script = {}) {
    runtime().reset(traits);
    open({}, {false, {}}, std::move(script));
    ASSERT_TRUE(present().ok());
    ASSERT_TRUE(frames_pass(5));
  }
  /// Advances the cameras' clock by `pause`; returns the actions until then.
  std::vector<Action> events_of(Duration pause) {
    EXPECT_TRUE(frames_pass(5));
    cameras_->manual_clock().advance(pause);
    std::vector<ClickerEvent> events;
    EXPECT_TRUE(headset_->clicker().poll(cameras_->clock().now(), events).ok());
    std::vector<Action> actions;
    for (const ClickerEvent& event : events) {
      actions.push_back(event.action);
    }
    return actions;
  }
};

TEST_F(SelectTest, PressesClicksAndHolds) {
  begin({});
  const Duration pause = std::chrono::milliseconds(200);
  runtime().press(true);
  EXPECT_THAT(events_of(pause), ElementsAre(Action::kPress));
  runtime().press(false);
  EXPECT_THAT(events_of(pause), ElementsAre(Action::kRelease, Action::kClick));
  EXPECT_THAT(events_of(std::chrono::seconds(2)), IsEmpty());
  runtime().press(true);
  EXPECT_THAT(events_of(std::chrono::seconds(1)), ElementsAre(Action::kPress, Action::kHold));
  runtime().press(false);
  EXPECT_THAT(events_of(pause), ElementsAre(Action::kRelease));
}

TEST_F(SelectTest, LetsGoWhenTheFocusGoes) {
  begin({});
  runtime().press(true);
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), ElementsAre(Action::kPress));
  runtime().tell(XR_SESSION_STATE_VISIBLE);
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), ElementsAre(Action::kRelease))
      << "nobody let go: it is no click";
}

TEST_F(SelectTest, LetsGoWhenTheControllerGoes) {
  begin({});
  runtime().press(true);
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), ElementsAre(Action::kPress));
  runtime().set_controller(false);
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), ElementsAre(Action::kRelease));
  runtime().press(false);
  runtime().set_controller(true);
  EXPECT_THAT(events_of(std::chrono::milliseconds(50)), IsEmpty());
  runtime().press(true);
  EXPECT_THAT(events_of(std::chrono::milliseconds(50)), ElementsAre(Action::kPress));
  runtime().press(false);
  EXPECT_THAT(events_of(std::chrono::milliseconds(50)),
              ElementsAre(Action::kRelease, Action::kClick));
}

/// The two ways in which a runtime reports a hand.
class HandTest : public SelectTest, public ::testing::WithParamInterface<bool> {
 protected:
  static bool by_joints() { return GetParam(); }
  static RuntimeTraits traits() {
    RuntimeTraits traits;
    traits.controller = false;
    traits.hand_tracking = by_joints();
    traits.hand_interaction = !by_joints();
    return traits;
  }
  static HandState open_hand() { return {true, 0.0f, true, 0.08f, true}; }
  static HandState closed_hand() { return {true, 1.0f, true, 0.010f, true}; }
  static HandState half_open_hand() { return {true, 0.7f, true, 0.022f, true}; }
  std::vector<Action> events_after(const HandState& hand) {
    runtime().set_hand(1, hand);
    return events_of(std::chrono::milliseconds(100));
  }
};

TEST_P(HandTest, PressesByAPinch) {
  begin(traits());
  EXPECT_THAT(events_after(open_hand()), IsEmpty());
  EXPECT_THAT(events_after(half_open_hand()), IsEmpty());
  EXPECT_THAT(events_after(closed_hand()), ElementsAre(Action::kPress));
  EXPECT_THAT(events_after(half_open_hand()), IsEmpty()) << "it trembles";
  EXPECT_THAT(events_after(open_hand()), ElementsAre(Action::kRelease, Action::kClick));
}

TEST_P(HandTest, DoesNotPressByAHandThatComesIntoViewClosed) {
  begin(traits());
  EXPECT_THAT(events_after(closed_hand()), IsEmpty()) << "around an instrument";
  EXPECT_THAT(events_after(open_hand()), IsEmpty());
  EXPECT_THAT(events_after(closed_hand()), ElementsAre(Action::kPress));
}

TEST_P(HandTest, LetsGoWithoutAClickWhenTheHandIsLost) {
  begin(traits());
  events_after(open_hand());
  EXPECT_THAT(events_after(closed_hand()), ElementsAre(Action::kPress));
  EXPECT_THAT(events_after({}), ElementsAre(Action::kRelease));
  EXPECT_THAT(events_after(closed_hand()), IsEmpty()) << "until it was seen open";
}

TEST_P(HandTest, DoesNotPressByAHandThatIsOnlyGuessed) {
  begin(traits());
  HandState guessed = open_hand();
  guessed.tips_tracked = guessed.ready = false;
  events_after(guessed);
  guessed = closed_hand();
  guessed.tips_tracked = guessed.ready = false;
  EXPECT_THAT(events_after(guessed), IsEmpty());
}

TEST_P(HandTest, IsNoButtonWhereTheHeadsetSeesNoHands) {
  RuntimeTraits blind = traits();
  blind.sees_hands = false;
  blind.hand_interaction = false;
  begin(blind);
  events_after(open_hand());
  EXPECT_THAT(events_after(closed_hand()), IsEmpty());
}

TEST_P(HandTest, LeavesAControllerInTheOtherHandAsItIs) {
  RuntimeTraits both = traits();
  both.controller = true;
  begin(both);
  runtime().set_hand(0, open_hand());
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), IsEmpty());
  runtime().press(true);
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), ElementsAre(Action::kPress));
  runtime().set_hand(0, closed_hand());
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), IsEmpty()) << "one button";
  runtime().set_hand(0, open_hand());
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), IsEmpty());
  runtime().press(false);
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)),
              ElementsAre(Action::kRelease, Action::kClick));
}

INSTANTIATE_TEST_SUITE_P(Ways, HandTest, ::testing::Bool(), [](const auto& by_joints) {
  return std::string(by_joints.param ? "joints" : "interaction");
});

TEST_F(SelectTest, IsNeverPressedWithoutAController) {
  RuntimeTraits traits;
  traits.controller = false;
  begin(traits);
  runtime().press(true);
  EXPECT_THAT(events_of(std::chrono::seconds(1)), IsEmpty());
}

TEST_F(SelectTest, SharesTheButtonWithTheOtherClicker) {
  fake::Script script;
  const auto at = [](int ms) { return kStart + std::chrono::milliseconds(ms); };
  script.clicker = {
      {Action::kPress, at(100)}, {Action::kRelease, at(900)}, {Action::kClick, at(900)}};
  begin({}, std::move(script));
  EXPECT_THAT(events_of(std::chrono::milliseconds(200)), ElementsAre(Action::kPress));
  runtime().press(true);  // ignored while the other clicker's is down
  EXPECT_THAT(events_of(std::chrono::milliseconds(100)), IsEmpty());
  runtime().press(false);
  EXPECT_THAT(events_of(std::chrono::milliseconds(1000)),
              ElementsAre(Action::kRelease, Action::kClick));
}

}  // namespace
}  // namespace orthonav::test::select_test
