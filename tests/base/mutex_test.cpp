#include "base/mutex.h"

#include <gtest/gtest.h>

#include <thread>

namespace orthonav {
namespace {

/// A turn that two threads hand back and forth.
class Turn {
 public:
  void pass(int from) {
    {
      const MutexLock lock(mutex_);
      while (turn_ != from) {
        changed_.wait(mutex_);
      }
      ++turn_;
    }
    changed_.notify_all();
  }
  int turn() {
    const MutexLock lock(mutex_);
    return turn_;
  }

 private:
  Mutex mutex_;
  ConditionVariable changed_;
  int turn_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

TEST(ConditionVariable, TwoThreadsTakeTurns) {
  constexpr int kTurns = 200;
  Turn turn;
  std::thread odd([&] {
    for (int i = 1; i < kTurns; i += 2) {
      turn.pass(i);
    }
  });
  for (int i = 0; i < kTurns; i += 2) {
    turn.pass(i);
  }
  odd.join();
  EXPECT_EQ(turn.turn(), kTurns);
}

TEST(ConditionVariable, WaitEndsWhenItsTimeHasComeAndHoldsTheMutex) {
  Mutex mutex;
  ConditionVariable never;
  int shared = 0;
  std::thread other;
  {
    const MutexLock lock(mutex);
    // A wait may also end for no reason.
    while (never.wait_until(mutex, std::chrono::steady_clock::time_point{})) {
    }
    // Under ThreadSanitizer a mutex that the wait has lost would be a race.
    other = std::thread([&] {
      const MutexLock in_turn(mutex);
      shared *= 2;
    });
    shared = 1;
  }
  other.join();
  EXPECT_EQ(shared, 2);
}

}  // namespace
}  // namespace orthonav
