#include <thread>
#include <utility>

#include "base/guarded.h"
#include "base/stopwatch.h"
#include "engine/live/frame_loop.h"
#include "engine/session/work_watch.h"

// The drawing thread: draws what the tracking thread hands over, and watches it.

namespace orthonav::engine {
namespace {

/// While no snapshot arrives, the drawing thread checks this often whether the tracking thread
/// hangs.
constexpr auto kLookEvery = std::chrono::milliseconds(50);
static_assert(kStallAfter + kLookEvery <= std::chrono::milliseconds(500),
              "what stalls is named within half a second");

}  // namespace

/// When a frame that is drawn now lights up.
Timestamp FrameLoop::lights_up() const {
  return headset_->clock().now() + Duration(ahead_ns_.load());
}

/// The loop, with a thread beside it that draws. If both fail, the loop's Error is returned.
Status FrameLoop::loop_and_draw(LoopReport& report) {
  SnapshotQueue queue(options_.real_time ? SnapshotQueue::WhenFull::kDropOldest
                                         : SnapshotQueue::WhenFull::kWait);
  LoopReport drawing;
  Status drawn;
  std::thread drawer([&] {
    drawn = guarded("renderer", [&] { return draw_all(queue, drawing); });
    if (!drawn) {
      stop();
      queue.close();  // tracking must not wait for a thread that is gone
    }
  });
  const Status tracked = loop(&queue, report);
  queue.close();
  drawer.join();
  report.drawn = drawing.drawn;
  report.stalls += drawing.stalls;
  report.draw_failures = drawing.failures;
  if (drawing.failures > 0) {
    report.last_failure = drawing.last_failure;
  }
  report.draw_wall_ms = drawing.draw_wall_ms;
  report.dropped_snapshots = queue.dropped();
  return tracked ? drawn : tracked;
}

void FrameLoop::capture(SnapshotQueue& queue, const Guidance& guidance, std::int64_t frame) {
  Snapshot* snapshot = queue.acquire();
  if (!snapshot) {
    return;
  }
  snapshot->frame = frame;
  snapshot->display_time = guidance.display_time;
  snapshot->step = guidance.status.at;
  snapshot->blank = guidance.blank;
  snapshot->map_epoch = frame_.map_epoch;
  snapshot->expires.reset();
  snapshot->tool_time = builder_.visible().pose_time;
  snapshot->tip_to_entry_m.reset();
  if (const nav::ScrewGuidance* triangle = builder_.visible().triangle) {
    snapshot->tip_to_entry_m = triangle->tip_to_entry_m;
  }
  if (const auto& pose_time = builder_.visible().pose_time) {
    snapshot->expires = *pose_time + guidance.stale_after;
  }
  builder_.write_scene(guidance, snapshot->scene);
  write_patches(guidance, snapshot->patches);
  for (LoopObserver* observer : observers_) {
    observer->captured(*snapshot);
  }
  queue.publish(snapshot);
}

Status FrameLoop::draw_into_sink(const Snapshot& snapshot) {
  const Working working(&*beats_, Part::kRenderer);
  return sink_->draw(snapshot);
}

/// Draws a notice in place of everything else, naming the part in which the tracking thread hangs.
/// Before the first snapshot it stands alone.
void FrameLoop::warn_of_stall(const Snapshot* last, std::optional<Part>& warned,
                              LoopReport& drawing) {
  const std::optional<Part> stalled = beats_->tracking_stalled();
  if (!stalled || stalled == warned) {
    return;
  }
  const Snapshot none;
  const Snapshot& before = last ? *last : none;
  Snapshot warning;
  warning.frame = before.frame;
  warning.display_time = lights_up();
  warning.step = before.step;
  warning.map_epoch = before.map_epoch;
  warning.blank = true;
  write_notice_alone(before.scene, stalled_text(*stalled), warning.scene);
  warned = stalled;
  ++drawing.stalls;
  for (LoopObserver* observer : observers_) {
    observer->part_stalled(*stalled);
  }
  if (const Status drawn = draw_into_sink(warning); !drawn) {
    ++drawing.failures;
    drawing.last_failure = drawn.error().message;
  }
}

/// Waits for the next snapshot, and meanwhile makes warnings from the last one; null at the end.
Snapshot* FrameLoop::await_snapshot(SnapshotQueue& queue, Snapshot* last, LoopReport& drawing) {
  std::optional<Part> warned;
  std::optional<Snapshot*> next;
  while (!(next = queue.take_until(Stopwatch().after(kLookEvery)))) {
    warn_of_stall(last, warned, drawing);
  }
  if (last) {
    queue.release(last);
  }
  return *next;
}

/// Draws until the queue is closed and empty. After too many failures in a row it fails for good
/// and stops the loop, since a surgeon who sees nothing must be told. The remaining snapshots are
/// taken without being drawn, so that tracking never waits for a drawer that gave up.
Status FrameLoop::draw_all(SnapshotQueue& queue, LoopReport& drawing) {
  Status status;
  int in_a_row = 0;
  Snapshot* last = nullptr;
  // If every snapshot is drawn, the pictures are for later, and the device's clock runs ahead of
  // them, so it shows neither what is too old nor what hangs.
  while (Snapshot* snapshot =
             options_.real_time ? await_snapshot(queue, last, drawing) : queue.take()) {
    if (options_.real_time && snapshot->expires && lights_up() > *snapshot->expires) {
      hide_tool_guidance(snapshot->scene);
      snapshot->tool_time.reset();
    }
    if (status.ok()) {
      const Stopwatch watch;
      const Status drawn = draw_into_sink(*snapshot);
      drawing.draw_wall_ms.add(watch.elapsed_ms());
      drawing.drawn += drawn ? 1 : 0;
      status = tolerate(drawn, in_a_row, drawing);
      if (!status) {
        stop();
      }
    }
    if (options_.real_time) {
      last = snapshot;
    } else {
      queue.release(snapshot);
    }
  }
  return status;
}

}  // namespace orthonav::engine
