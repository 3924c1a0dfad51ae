#pragma once

#include <deque>
#include <utility>

#include "base/mutex.h"
#include "hal/api/depth_camera.h"

namespace orthonav::hl2ss {

/// Holds the newest pictures of a depth camera until they are taken; a slow reader misses the
/// oldest. Thread-safe; buffers are reused.
class DepthMailbox {
 public:
  /// Swaps `picture` in.
  void put(DepthFrame& picture) {
    const MutexLock lock(mutex_);
    if (waiting_.size() == kMost) {
      spare_.push_back(std::move(waiting_.front()));
      waiting_.pop_front();
    }
    DepthFrame place;
    if (!spare_.empty()) {
      place = std::move(spare_.front());
      spare_.pop_front();
    }
    std::swap(place, picture);
    place.sequence = next_sequence_++;
    waiting_.push_back(std::move(place));
  }
  /// Swaps the oldest one into `picture`, if its time has come.
  bool take(Timestamp now, DepthFrame& picture) {
    const MutexLock lock(mutex_);
    if (waiting_.empty() || waiting_.front().time > now) {
      return false;
    }
    std::swap(picture, waiting_.front());
    if (spare_.size() < kMost) {
      spare_.push_back(std::move(waiting_.front()));
    }
    waiting_.pop_front();
    return true;
  }

 private:
  /// A recorder takes pictures 30 times a second, and the camera sends 45.
  static constexpr std::size_t kMost = 4;
  Mutex mutex_;
  std::deque<DepthFrame> waiting_ ORTHONAV_GUARDED_BY(mutex_);
  std::deque<DepthFrame> spare_ ORTHONAV_GUARDED_BY(mutex_);
  std::int64_t next_sequence_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav::hl2ss
