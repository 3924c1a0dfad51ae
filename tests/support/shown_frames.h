#pragma once

#include <vector>

#include "base/mutex.h"
#include "engine/live/frame_loop.h"

namespace orthonav::test {

/// Keeps what a loop shows. Thread-safe.
class ShownFrames : public engine::LoopObserver {
 public:
  void shown(const engine::ShownFrame& frame) override {
    const MutexLock lock(mutex_);
    frames_.push_back(frame);
  }
  [[nodiscard]] std::vector<engine::ShownFrame> frames() const {
    const MutexLock lock(mutex_);
    return frames_;
  }
  void clear() {
    const MutexLock lock(mutex_);
    frames_.clear();
  }

 private:
  mutable Mutex mutex_;
  std::vector<engine::ShownFrame> frames_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::test
