#include "engine/live/snapshot_queue.h"

namespace orthonav::engine {

SnapshotQueue::SnapshotQueue(WhenFull when_full) : when_full_(when_full), slots_(kSlots) {
  ready_.reserve(kSlots);
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    slots_[i].slot = i;
    free_.push_back(&slots_[i]);
  }
}

void SnapshotQueue::drop_oldest() {
  free_.push_back(ready_.front());
  ready_.erase(ready_.begin());
  ++dropped_;
}

Snapshot* SnapshotQueue::acquire() {
  const MutexLock lock(mutex_);
  if (free_.empty() && when_full_ == WhenFull::kDropOldest && !ready_.empty()) {
    drop_oldest();
  }
  while (!closed_ && free_.empty()) {
    changed_.wait(mutex_);
  }
  if (closed_) {
    return nullptr;
  }
  // In turn, so that all have grown to the scene before long.
  Snapshot* slot = free_.front();
  free_.erase(free_.begin());
  return slot;
}

void SnapshotQueue::publish(Snapshot* filled) {
  {
    const MutexLock lock(mutex_);
    ready_.push_back(filled);
  }
  changed_.notify_all();
}

Snapshot* SnapshotQueue::take() {
  const MutexLock lock(mutex_);
  while (!closed_ && ready_.empty()) {
    changed_.wait(mutex_);
  }
  return take_next();
}

std::optional<Snapshot*> SnapshotQueue::take_until(std::chrono::steady_clock::time_point until) {
  const MutexLock lock(mutex_);
  while (!closed_ && ready_.empty() && changed_.wait_until(mutex_, until)) {
  }
  return closed_ || !ready_.empty() ? std::optional(take_next()) : std::nullopt;
}

Snapshot* SnapshotQueue::take_next() {
  if (ready_.empty()) {
    return nullptr;
  }
  while (when_full_ == WhenFull::kDropOldest && ready_.size() > 1) {
    drop_oldest();
  }
  Snapshot* next = ready_.front();
  ready_.erase(ready_.begin());
  return next;
}

void SnapshotQueue::release(Snapshot* drawn) {
  {
    const MutexLock lock(mutex_);
    free_.push_back(drawn);
  }
  changed_.notify_all();
}

void SnapshotQueue::close() {
  {
    const MutexLock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

std::int64_t SnapshotQueue::dropped() const {
  const MutexLock lock(mutex_);
  return dropped_;
}

}  // namespace orthonav::engine
