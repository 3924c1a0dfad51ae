#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "base/time.h"

namespace orthonav::hl2ss {

/// Events from the receiving thread, taken in the order of their times. Drops the oldest when full.
/// Thread-safe.
template <class Event>
class Inbox {
 public:
  /// Puts it among those that wait, with its own time. False, and it is not put, if a later one was
  /// taken already: it can no longer be delivered in order, and to deliver it as if it were younger
  /// would let an answer pass that was given before its question.
  [[nodiscard]] bool put(Event event) {
    const MutexLock lock(mutex_);
    if (last_taken_ && event.time < *last_taken_) {
      return false;
    }
    if (events_.size() == kMost) {
      events_.pop_front();
    }
    const auto after =
        std::upper_bound(events_.begin(), events_.end(), event.time,
                         [](Timestamp time, const Event& waiting) { return time < waiting.time; });
    events_.insert(after, std::move(event));
    return true;
  }
  void take_until(Timestamp until, std::vector<Event>& to) {
    const MutexLock lock(mutex_);
    while (!events_.empty() && events_.front().time <= until) {
      last_taken_ = events_.front().time;
      to.push_back(std::move(events_.front()));
      events_.pop_front();
    }
  }
  /// The time of the newest event that was taken.
  [[nodiscard]] std::optional<Timestamp> last_taken() const {
    const MutexLock lock(mutex_);
    return last_taken_;
  }

 private:
  static constexpr std::size_t kMost = 256;
  mutable Mutex mutex_;
  std::deque<Event> events_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Timestamp> last_taken_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::hl2ss
