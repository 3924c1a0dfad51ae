#pragma once

#include <atomic>
#include <cstdint>

#include "base/wall_clock.h"
#include "hal/replay/replay_headset.h"

namespace orthonav::replay {

/// Progress of a replay. Written by the cameras, read from any thread.
struct Progress {
  std::atomic<Timestamp> clock{};
  std::atomic<bool> pairs_over{false};  ///< and the caller was told so
  std::atomic<Timestamp> frame_time{Timestamp::min()};
  std::atomic<std::int64_t> sequence{-1};

  /// Never moves backwards.
  void advance_to(Timestamp time) {
    Timestamp now = clock.load();
    while (now < time && !clock.compare_exchange_weak(now, time)) {
    }
  }
};

/// In real time, the wall clock from the recording's start on; otherwise the cameras' time.
class ReplayClock : public Clock {
 public:
  ReplayClock(const Progress& progress, const ReplayOptions& options, Timestamp start)
      : progress_(progress),
        wall_(options.wall ? *options.wall : this_machine_),
        realtime_(options.pace == ReplayPace::kRealtime),
        start_(start),
        opened_(wall_.now()) {}
  [[nodiscard]] Timestamp now() const override {
    return realtime_ ? start_ + (wall_.now() - opened_) : progress_.clock.load();
  }
  [[nodiscard]] bool runs_by_itself() const override { return realtime_; }

 private:
  const Progress& progress_;
  WallClock this_machine_;
  const Clock& wall_;
  bool realtime_;
  Timestamp start_;
  Timestamp opened_;
};

}  // namespace orthonav::replay
