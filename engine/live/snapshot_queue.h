#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/mutex.h"
#include "base/time.h"
#include "engine/holograms/labels/glare_patches.h"
#include "engine/session/shown_status.h"
#include "render/scene.h"

namespace orthonav::engine {

/// The data of one displayed frame for the rendering thread.
struct Snapshot {
  std::int64_t frame = 0;  ///< counts displayed frames from 0
  std::size_t slot = 0;  ///< index of this buffer, so that a caller can keep its own data for each
  Timestamp display_time{};
  StepOnDisplay step;
  /// After this time, tool guidance is too old to be shown; absent if there is none.
  std::optional<Timestamp> expires;
  /// Mid-exposure of the pair from which the scene's tool guidance comes; absent if there is none.
  std::optional<Timestamp> tool_time;
  /// From the tool's tip to the entry point; absent without a deviation triangle.
  std::optional<double> tip_to_entry_m;
  std::int64_t map_epoch = 0;  ///< of the scene's World (StereoFrame::map_epoch)
  bool blank = false;          ///< the loop has ended: only the status line is shown
  render::Scene scene;  ///< with labels at their original places; the drawing thread lays them out
  std::vector<GlarePatch> patches;  ///< where labels would be unreadable
};

/// A few snapshots that circulate between two threads. The buffers are made once and reused.
class SnapshotQueue {
 public:
  enum class WhenFull {
    kWait,       ///< every snapshot is drawn, independently of speed
    kDropOldest  ///< the newest counts: tracking never waits for rendering
  };
  static constexpr std::size_t kSlots = 4;

  explicit SnapshotQueue(WhenFull when_full);
  /// A buffer to fill; return it with `publish`. Null once closed.
  Snapshot* acquire();
  void publish(Snapshot* filled);
  /// The next to draw. Under kWait the oldest one waiting; under kDropOldest the newest, and those
  /// before it are dropped. Blocks until there is one. Null once closed and empty.
  Snapshot* take();
  /// The same, but blocks no longer than `until`; absent if there was none by then.
  std::optional<Snapshot*> take_until(std::chrono::steady_clock::time_point until);
  void release(Snapshot* drawn);
  /// No more will be published; the taker still gets the remaining ones.
  void close();
  [[nodiscard]] std::int64_t dropped() const;

 private:
  [[nodiscard]] Snapshot* take_next() ORTHONAV_REQUIRES(mutex_);
  /// Drops the oldest of those waiting to be drawn.
  void drop_oldest() ORTHONAV_REQUIRES(mutex_);

  WhenFull when_full_;
  std::vector<Snapshot> slots_;  ///< each belongs to the thread that acquired or took it
  mutable Mutex mutex_;
  ConditionVariable changed_;
  std::vector<Snapshot*> free_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<Snapshot*> ready_ ORTHONAV_GUARDED_BY(mutex_);  ///< the oldest first
  bool closed_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::int64_t dropped_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav::engine
