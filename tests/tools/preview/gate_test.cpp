#include "tools/preview/gate.h"

#include <gtest/gtest.h>

#include "hal/fake/scripted.h"
#include "tests/support/telling_headset.h"
#include "tools/preview/preview_headset.h"

namespace orthonav::preview::gate_test {
namespace {

using std::chrono::milliseconds;

constexpr Duration kInterval = milliseconds(33);

/// A stream of pairs behind a gate, and the wall clock.
struct Stream {
  fake::ManualClock wall{Timestamp(milliseconds(1000))};
  Gate gate{wall};
  Timestamp pair{milliseconds(5000)};

  bool next() {
    if (!gate.may_pass()) {
      return false;
    }
    pair += kInterval;
    gate.pass(pair);
    return true;
  }
  int pass_all(int most) {
    int passed = 0;
    while (passed < most && next()) {
      ++passed;
    }
    return passed;
  }
};

TEST(Gate, GoesAtThePaceOfTheWall) {
  Stream stream;
  EXPECT_TRUE(stream.next());
  EXPECT_TRUE(stream.next());  // From here on it is timed.
  EXPECT_FALSE(stream.next());
  stream.wall.advance(milliseconds(32));
  EXPECT_FALSE(stream.next());
  stream.wall.advance(milliseconds(2));
  EXPECT_TRUE(stream.next());
  EXPECT_FALSE(stream.next());
}

TEST(Gate, IsSlowerOrFasterByItsSpeed) {
  Stream stream;
  stream.gate.set_speed(4.0);
  stream.pass_all(2);
  stream.wall.advance(milliseconds(99));
  EXPECT_EQ(stream.pass_all(100), 12);
  stream.gate.set_speed(0.0);
  EXPECT_EQ(stream.pass_all(100), 100);
}

TEST(Gate, DoesNotRushAfterAStandstill) {
  Stream stream;
  stream.pass_all(2);
  stream.wall.advance(std::chrono::seconds(10));
  EXPECT_LE(stream.pass_all(1000), 3);
}

TEST(Gate, LetsNothingThroughWhilePausedButSteps) {
  Stream stream;
  stream.gate.set_speed(0.0);
  stream.gate.pause(true);
  EXPECT_EQ(stream.pass_all(10), 0);
  stream.gate.step(2);
  EXPECT_EQ(stream.pass_all(10), 2);
  stream.gate.pause(false);
  stream.gate.step(2);
  EXPECT_EQ(stream.pass_all(10), 10);
}

TEST(Gate, RunsToAPairAndStopsThere) {
  Stream stream;
  stream.gate.pause(true);
  stream.gate.run_to(25);
  EXPECT_EQ(stream.pass_all(1000), 25);
  EXPECT_EQ(stream.gate.passed(), 25);
  stream.gate.run_to(10);
  EXPECT_EQ(stream.pass_all(1000), 0);
  stream.gate.restart();
  EXPECT_EQ(stream.gate.passed(), 0);
  EXPECT_EQ(stream.pass_all(1000), 0);
}

TEST(PreviewHeadset, PassesOnWhatItsDeviceTells) {
  test::TellingHeadset device;
  fake::ManualClock wall;
  Gate gate{wall};
  Keyboard keyboard;
  PreviewHeadset shown(device, gate, keyboard);
  test::expect_passed_on(device, shown, true);
}

}  // namespace
}  // namespace orthonav::preview::gate_test
