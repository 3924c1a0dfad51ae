#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/api/devices.h"

namespace orthonav {

void PrintTo(const ClickerEvent& event, std::ostream* out) {
  *out << "action " << static_cast<int>(event.action) << " at "
       << event.time.time_since_epoch().count() / 1'000'000 << " ms";
}

namespace {

using enum ClickerAction;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Timestamp ms(int t) { return Timestamp(milliseconds(t)); }

class ClickTimerTest : public ::testing::Test {
 protected:
  void down(int t) { timer_.button(true, ms(t), events_); }
  void up(int t) { timer_.button(false, ms(t), events_); }
  void now(int t) { timer_.advance(ms(t), events_); }

  ClickTimer timer_;  // double within 300 ms, hold after 500 ms
  std::vector<ClickerEvent> events_;
};

TEST_F(ClickTimerTest, MakesAClickOfAShortPress) {
  down(1000);
  now(1100);
  up(1200);
  EXPECT_THAT(events_, ElementsAre(ClickerEvent{kPress, ms(1000)}, ClickerEvent{kRelease, ms(1200)},
                                   ClickerEvent{kClick, ms(1200)}));
}

TEST_F(ClickTimerTest, MakesADoubleClickOfTwoQuickPresses) {
  down(0);
  up(100);
  down(300);  // exactly the limit
  up(400);
  EXPECT_THAT(events_,
              ElementsAre(ClickerEvent{kPress, ms(0)}, ClickerEvent{kRelease, ms(100)},
                          ClickerEvent{kClick, ms(100)}, ClickerEvent{kPress, ms(300)},
                          ClickerEvent{kRelease, ms(400)}, ClickerEvent{kDoubleClick, ms(400)}));
}

TEST_F(ClickTimerTest, MakesTwoClicksOfSlowerPresses) {
  down(0);
  up(100);
  down(301);  // one past the limit
  up(400);
  EXPECT_EQ(events_.back(), (ClickerEvent{kClick, ms(400)}));
}

TEST_F(ClickTimerTest, StartsAnewAfterADoubleClick) {
  for (const int t : {0, 200, 400, 600}) {
    down(t);
    up(t + 50);
  }
  std::vector<ClickerAction> clicks;
  for (const ClickerEvent& event : events_) {
    if (event.action == kClick || event.action == kDoubleClick) {
      clicks.push_back(event.action);
    }
  }
  EXPECT_THAT(clicks, ElementsAre(kClick, kDoubleClick, kClick, kDoubleClick));
}

TEST_F(ClickTimerTest, TellsAHoldOnceWhenItsTimeHasCome) {
  down(0);
  now(500);  // a release now would still be a click
  EXPECT_EQ(events_.size(), 1u);
  now(501);
  now(900);
  EXPECT_THAT(events_, ElementsAre(ClickerEvent{kPress, ms(0)}, ClickerEvent{kHold, ms(500)}));
  up(1000);
  EXPECT_EQ(events_.back(), (ClickerEvent{kRelease, ms(1000)}));
}

TEST_F(ClickTimerTest, TellsAHoldThatNobodyAskedForAtItsRelease) {
  down(0);
  up(800);
  EXPECT_THAT(events_, ElementsAre(ClickerEvent{kPress, ms(0)}, ClickerEvent{kHold, ms(500)},
                                   ClickerEvent{kRelease, ms(800)}));
}

TEST_F(ClickTimerTest, CountsNoHoldAsFirstClick) {
  timer_.double_within = milliseconds(2000);
  down(0);
  up(800);
  down(900);
  up(950);
  EXPECT_EQ(events_.back(), (ClickerEvent{kClick, ms(950)}));
}

TEST_F(ClickTimerTest, IgnoresAButtonThatIsWhereItWas) {
  up(0);
  EXPECT_THAT(events_, IsEmpty());
  down(100);
  down(130);
  down(160);
  EXPECT_EQ(events_.size(), 1u);
}

}  // namespace
}  // namespace orthonav
