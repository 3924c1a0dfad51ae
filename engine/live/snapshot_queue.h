#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "base/mutex.h"
#include "base/time.h"
#include "hal/api/shown_status.h"
#include "render/scene.h"

namespace orthonav::engine {

/// What the rendering thread gets of one displayed frame.
struct Snapshot {
  std::int64_t frame = 0;  ///< counts displayed frames from 0
  std::size_t slot = 0;    ///< index of this buffer: a caller keeps its own data beside it
  Timestamp display_time{};
  StepOnDisplay step;
  /// Shown after this, what guides a tool is too old to be seen; absent when nothing does.
  std::optional<Timestamp> expires;
  bool blank = false;  ///< the loop has ended: nothing but the status line
  render::Scene scene;
};

/// A few snapshots going round between two threads. The buffers are made once and reused.
class SnapshotQueue {
 public:
  enum class WhenFull {
    kWait,       ///< every snapshot is drawn: what is drawn does not depend on speed
    kDropOldest  ///< the newest counts: tracking never waits for rendering
  };
  static constexpr std::size_t kSlots = 4;

  explicit SnapshotQueue(WhenFull when_full);
  /// A buffer to fill; give it back by `publish`. Null once closed.
  Snapshot* acquire();
  void publish(Snapshot* filled);
  /// The next to draw: under kWait the oldest that waits; under kDropOldest the newest, while those
  /// before it are dropped. Blocks until there is one. Null once closed and empty.
  Snapshot* take();
  void release(Snapshot* drawn);
  /// No more is published; the taker gets what is left.
  void close();
  [[nodiscard]] std::int64_t dropped() const;

 private:
  /// Of those that wait to be drawn.
  void drop_oldest() ORTHONAV_REQUIRES(mutex_);

  WhenFull when_full_;
  std::vector<Snapshot> slots_;  ///< each belongs to whoever acquired or took it
  mutable Mutex mutex_;
  ConditionVariable changed_;
  std::vector<Snapshot*> free_ ORTHONAV_GUARDED_BY(mutex_);
  std::deque<Snapshot*> ready_ ORTHONAV_GUARDED_BY(mutex_);
  bool closed_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::int64_t dropped_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav::engine
