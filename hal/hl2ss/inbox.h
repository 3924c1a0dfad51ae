#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "base/time.h"

namespace orthonav::hl2ss {

/// Events from the receiving thread, taken by time. Drops the oldest when full. Thread-safe.
template <class Event>
class Inbox {
 public:
  void put(Event event) {
    const MutexLock lock(mutex_);
    // An event that arrives later may have an earlier stamp; the contract requires order.
    if (last_ && event.time < *last_) {
      event.time = *last_;
    }
    last_ = event.time;
    if (events_.size() == kMost) {
      events_.pop_front();
    }
    events_.push_back(std::move(event));
  }
  void take_until(Timestamp until, std::vector<Event>& to) {
    const MutexLock lock(mutex_);
    while (!events_.empty() && events_.front().time <= until) {
      to.push_back(std::move(events_.front()));
      events_.pop_front();
    }
  }

 private:
  static constexpr std::size_t kMost = 256;
  Mutex mutex_;
  std::deque<Event> events_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Timestamp> last_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::hl2ss
