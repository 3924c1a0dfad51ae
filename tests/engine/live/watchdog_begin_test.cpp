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
  LoopReport run(Headset& headset) {
    SceneBuilder builder;
    FrameLoop loop(headset, s.session(), builder, options);
    loop.draw_into(&sink);
    return loop.run();
  }
  test::ScriptedOperation s{{"L4"}, {}, Verification::kByTouch, true};
  WatchedSink sink;
  LoopOptions options;
};

TEST_F(CoachedLoop, ACoachThatHangsIsNamedBeforeItIsAwaited) {
  fake::FakeHeadset headset(pairs(60));
  std::atomic<int> trials = 0;
  // On the coach's thread. Once the frame loop waits for the answer, no time passes any more: what
  // names the coach by then is the beginning of its trial.
  s.before_registering = [&] {
    if (trials++ == 0) {
      headset.manual_clock().advance(kStallAfter + Duration(1));
      EXPECT_TRUE(wait_until([&] { return sink.drew_stall_of(Part::kCoach); }));
    }
  };
  const auto report = run(headset);
  ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
  EXPECT_GE(trials, 1);
  EXPECT_GE(report.stalls, 1);
  EXPECT_EQ(report.displayed, 60) << "and it goes on";
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
  EXPECT_TRUE(headset.display().frames().back().holograms.empty());
}

}  // namespace
}  // namespace orthonav::engine::watchdog_begin_test
