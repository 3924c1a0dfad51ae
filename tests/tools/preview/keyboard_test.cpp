#include "tools/preview/keyboard.h"

#include <gmock/gmock.h>

#include "hal/fake/scripted.h"

namespace orthonav::preview::keyboard_test {
namespace {

using std::chrono::milliseconds;
using enum ClickerAction;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Timestamp at_ms(int ms) { return Timestamp(milliseconds(ms)); }

/// A clicker of a headset beside the keyboard's.
struct Buttons {
  explicit Buttons(std::vector<ClickerEvent> events = {}) : inner(std::move(events)) {}
  fake::ScriptedClicker inner;
  Keyboard keyboard;
  SharedClicker shared{inner, keyboard};

  std::vector<ClickerAction> poll(int ms) {
    std::vector<ClickerEvent> events;
    const Status status = shared.poll(at_ms(ms), events);
    EXPECT_TRUE(status.ok()) << status.error().message;
    std::vector<ClickerAction> actions;
    for (const ClickerEvent& event : events) {
      actions.push_back(event.action);
    }
    return actions;
  }
};

TEST(SharedClicker, MakesClicksDoubleClicksAndHoldsOfTheKey) {
  Buttons buttons;
  buttons.keyboard.button(true);
  EXPECT_THAT(buttons.poll(1000), ElementsAre(kPress));
  buttons.keyboard.button(false);
  EXPECT_THAT(buttons.poll(1033), ElementsAre(kRelease, kClick));
  buttons.keyboard.button(true);
  buttons.keyboard.button(false);
  EXPECT_THAT(buttons.poll(1200), ElementsAre(kPress, kRelease, kDoubleClick));
  buttons.keyboard.button(true);
  EXPECT_THAT(buttons.poll(3000), ElementsAre(kPress));
  EXPECT_THAT(buttons.poll(3400), IsEmpty());
  EXPECT_THAT(buttons.poll(3600), ElementsAre(kHold));
}

TEST(SharedClicker, PassesTheHeadsetsOwnOnUnchanged) {
  const std::vector<ClickerEvent> own = {{kPress, at_ms(10)},    {kRelease, at_ms(60)},
                                         {kClick, at_ms(60)},    {kPress, at_ms(150)},
                                         {kRelease, at_ms(200)}, {kDoubleClick, at_ms(200)}};
  Buttons buttons(own);
  std::vector<ClickerEvent> events;
  ASSERT_TRUE(buttons.shared.poll(at_ms(500), events).ok());
  EXPECT_EQ(events, own);
}

TEST(SharedClicker, BelongsToWhoPressedFirst) {
  Buttons buttons({{kPress, at_ms(50)}, {kRelease, at_ms(150)}, {kClick, at_ms(150)}});
  buttons.keyboard.button(true);
  EXPECT_THAT(buttons.poll(30), ElementsAre(kPress));
  EXPECT_THAT(buttons.poll(100), IsEmpty());
  EXPECT_THAT(buttons.poll(200), IsEmpty());
  buttons.keyboard.button(false);
  EXPECT_THAT(buttons.poll(230), ElementsAre(kRelease, kClick));
}

TEST(SharedClicker, MakesNoDoubleClickOfTwoHands) {
  Buttons buttons({{kPress, at_ms(50)}, {kRelease, at_ms(60)}, {kClick, at_ms(60)}});
  EXPECT_THAT(buttons.poll(70), ElementsAre(kPress, kRelease, kClick));
  buttons.keyboard.button(true);
  buttons.keyboard.button(false);
  EXPECT_THAT(buttons.poll(100), ElementsAre(kPress, kRelease, kClick));
}

TEST(SharedClicker, MutedInTheMiddleOfAPressStillHearsItsRelease) {
  Buttons buttons({{kPress, at_ms(10)},
                   {kRelease, at_ms(60)},
                   {kClick, at_ms(60)},
                   {kPress, at_ms(500)},
                   {kRelease, at_ms(550)},
                   {kClick, at_ms(550)}});
  EXPECT_THAT(buttons.poll(30), ElementsAre(kPress));
  buttons.keyboard.mute(true);
  EXPECT_THAT(buttons.poll(100), ElementsAre(kRelease, kClick));
  EXPECT_THAT(buttons.poll(600), IsEmpty());
}

TEST(SharedVoice, SaysWhatIsTypedAtTheTimeAskedFor) {
  fake::ScriptedVoice inner({{"start", 0.9, at_ms(10)}, {"next", 0.9, at_ms(90)}});
  Keyboard keyboard;
  SharedVoice voice(inner, keyboard);
  std::vector<Phrase> phrases;
  keyboard.say("save");
  ASSERT_TRUE(voice.poll(at_ms(50), phrases).ok());
  EXPECT_THAT(phrases,
              ElementsAre(Phrase{"start", 0.9, at_ms(10)}, Phrase{"save", 1.0, at_ms(50)}));
  phrases.clear();
  keyboard.mute(true);
  ASSERT_TRUE(voice.poll(at_ms(100), phrases).ok());
  EXPECT_THAT(phrases, IsEmpty());
}

}  // namespace
}  // namespace orthonav::preview::keyboard_test
