// Parts that hang before anything was shown, and parts that hang beside the frame loop.
#include <gmock/gmock.h>

#include "engine/session/coach.h"
#include "tests/engine/live/watched_loop.h"
#include "tests/support/scripted_pairs.h"

namespace orthonav::engine::watchdog_begin_test {
namespace {

using test::pairs;
using test::wait_until;
using ::testing::ElementsAre;

/// Records which parts were named.
class Told : public LoopObserver {
 public:
  void part_stalled(Part part) override {
    const MutexLock lock(mutex_);
    parts_.push_back(part);
  }
  [[nodiscard]] std::vector<Part> parts() const {
    const MutexLock lock(mutex_);
    return parts_;
  }

 private:
  mutable Mutex mutex_;
  std::vector<Part> parts_ ORTHONAV_GUARDED_BY(mutex_);
};

TEST_F(WatchedLoop, WhatHangsBeforeTheFirstPairIsNamedToo) {
  fake::FakeHeadset inner(pairs(3));
  EventfulHeadset headset(
      inner, {0, [&] {
                inner.manual_clock().advance(kStallAfter + Duration(1));
                EXPECT_TRUE(wait_until([&] { return sink.drew_stall_of(Part::kCamera); }));
              }});
  Told told;
  const auto report = run(headset, &told);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.stalls, 1);
  EXPECT_THAT(told.parts(), ElementsAre(Part::kCamera)) << "as onlookers hear it";
}

TEST_F(WatchedLoop, ATrackerThatHangsAtTheFirstPairIsNamed) {
  fake::FakeHeadset inner(pairs(3));
  Stepped slow([&, steps = 0](const Guidance&) mutable {
    if (steps++ == 0) {
      inner.manual_clock().advance(kStallAfter + Duration(1));
      EXPECT_TRUE(wait_until([&] { return sink.drew_stall_of(Part::kTracker); }));
    }
  });
  const auto report = run(inner, &slow);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.stalls, 1);
}

/// As of a headset: time does not wait for a pair.
class RunningHeadset : public ForwardingHeadset {
 public:
  explicit RunningHeadset(fake::FakeHeadset& inner) : ForwardingHeadset(inner), clock_(inner) {}
  [[nodiscard]] const Clock& clock() const override { return clock_; }
  void advance(Duration by) { clock_.ahead_ns += by.count(); }

 private:
  struct Running : public Clock {
    explicit Running(fake::FakeHeadset& of) : inner(of) {}
    [[nodiscard]] Timestamp now() const override {
      return inner.clock().now() + Duration(ahead_ns.load());
    }
    fake::FakeHeadset& inner;
    std::atomic<Duration::rep> ahead_ns = 0;
  };
  Running clock_;
};

/// Stroking, with a trial of the coach about to begin.
class CoachedLoop : public ::testing::Test {
 protected:
  CoachedLoop() {
    options.real_time = true;
    s.tracker().pointer = test::pointer_at({0, 0.02, 0});
    s.says("start");
    s.does({ClickerAction::kPress});
    s.pairs(static_cast<int>(Coach::kFewestSamples) - 10);
  }
  LoopReport run(Headset& headset, LoopObserver* observer = nullptr) {
    SceneBuilder builder;
    FrameLoop loop(headset, s.session(), builder, options);
    loop.observe(&seen);
    loop.observe(observer);
    loop.draw_into(&sink);
    return loop.run();
  }
  test::ScriptedOperation s{{"L4"}, {}, Verification::kByTouch, true};
  WatchedSink sink;
  LoopOptions options;
  test::ShownFrames seen;
};

TEST_F(CoachedLoop, ACoachThatHangsIsNamedAndHoldsUpNothing) {
  fake::FakeHeadset inner(pairs(60));
  RunningHeadset headset(inner);
  std::atomic<bool> hangs = false;
  std::atomic<bool> let_go = false;
  s.before_registering = [&] {
    headset.advance(kTaskStallsAfter + Duration(1));
    hangs = true;
    EXPECT_TRUE(wait_until([&] { return let_go.load(); }));
  };
  std::optional<Part> named;
  Stepped see([&, pair = 0](const Guidance& guidance) mutable {
    named = guidance.status.stalled ? guidance.status.stalled : named;
    if (++pair == 30) {
      EXPECT_TRUE(wait_until([&] { return hangs.load(); }));
    }
  });
  const auto report = run(headset, &see);
  let_go = true;
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(named, Part::kCoach);
  EXPECT_EQ(report.stalls, 1);
  EXPECT_EQ(report.displayed, 60);
}

TEST_F(CoachedLoop, IsNotTimedByPairsThatComeFasterThanTime) {
  options.real_time = false;
  fake::FakeHeadset headset(pairs(60));
  // The trial is asked for at the tenth pair and answered fifteen later, however late its thread
  // begins; by the second to last of these, it has taken longer than a stall.
  constexpr int kPairsOfTrial = Coach::kPairsToAnswer - 2;
  ASSERT_GT(kPairsOfTrial * test::kPair, kStallAfter);
  const Timestamp late = test::kStart + (10 + kPairsOfTrial) * test::kPair;
  std::atomic<int> trials = 0;
  s.before_registering = [&] {
    if (trials++ == 0) {
      EXPECT_TRUE(wait_until([&] { return headset.clock().now() >= late; }));
    }
  };
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_GE(trials, 1);
  EXPECT_EQ(report.stalls, 0) << "time that only pairs make says nothing about the coach";
}

TEST_F(CoachedLoop, ACoachThatDiesEndsTheRunInOrder) {
  fake::FakeHeadset headset(pairs(60));
  s.before_registering = [] { throw std::bad_alloc(); };
  const auto report = run(headset);
  ASSERT_FALSE(report.ended.ok());
  EXPECT_EQ(report.ended.error().message, "coach: out of memory");
  EXPECT_TRUE(seen.frames().back().holograms.empty());
}

/// Strokes are saved and their registration is asked for; it begins before the loop does.
class RegisteringLoop : public CoachedLoop {
 protected:
  RegisteringLoop() {
    s.does({ClickerAction::kRelease});
    s.says("save");
    s.time_runs = true;
  }
  LoopReport run() {
    Stepped see([this, pair = 0](const Guidance& guidance) mutable {
      named = guidance.status.stalled ? guidance.status.stalled : named;
      begun = true;
      if (++pair == kPairs / 2) {
        EXPECT_TRUE(wait_until([this] { return acted.load(); }));
      }
    });
    return CoachedLoop::run(headset, &see);
  }
  static constexpr int kPairs = 60;
  fake::FakeHeadset inner{pairs(kPairs)};
  RunningHeadset headset{inner};
  std::optional<Part> named;        ///< as stalled
  std::atomic<bool> begun = false;  ///< the loop
  std::atomic<bool> acted = false;  ///< the registration did what it is to do in the first half
  std::atomic<bool> let_go = false;
};

TEST_F(RegisteringLoop, ARegistrationThatTakesLongHoldsUpNothingAndIsNoStall) {
  s.before_registering = [&] {
    headset.advance(kTaskStallsAfter / 2);
    acted = true;
    EXPECT_TRUE(wait_until([&] { return let_go.load(); }));
  };
  ASSERT_EQ(s.does({ClickerAction::kDoubleClick}).step, Step::kRegistering);
  const auto report = run();  // would hang here if a pair waited
  let_go = true;
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(report.displayed, kPairs);
  EXPECT_EQ(report.stalls, 0);
  EXPECT_EQ(named, std::nullopt);
}

TEST_F(RegisteringLoop, ARegistrationThatDoesNotReturnIsNamed) {
  s.before_registering = [&] {
    EXPECT_TRUE(wait_until([&] { return begun.load(); }));
    headset.advance(kTaskStallsAfter + Duration(1));
    acted = true;
    EXPECT_TRUE(wait_until([&] { return let_go.load(); }));
  };
  s.does({ClickerAction::kDoubleClick});
  const auto report = run();
  let_go = true;
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_EQ(named, Part::kRegistration);
  EXPECT_EQ(report.stalls, 1);
  EXPECT_EQ(report.displayed, kPairs);
}

TEST_F(RegisteringLoop, ARegistrationThatDiesEndsTheRunInOrder) {
  s.before_registering = [&] {
    EXPECT_TRUE(wait_until([&] { return begun.load(); }));
    acted = true;
    throw std::bad_alloc();
  };
  s.does({ClickerAction::kDoubleClick});
  const auto report = run();
  ASSERT_FALSE(report.ended.ok());
  EXPECT_EQ(report.ended.error().message, "registration: out of memory");
  EXPECT_LT(report.displayed, kPairs);
  ASSERT_FALSE(seen.frames().empty());
  EXPECT_TRUE(seen.frames().back().holograms.empty());
}

}  // namespace
}  // namespace orthonav::engine::watchdog_begin_test
