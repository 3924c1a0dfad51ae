#include "engine/frame_loop.h"

#include <chrono>
#include <thread>

namespace orthonav::engine {
namespace {

/// Wall time, for the timing plot only; no decision reads it.
class Stopwatch {
 public:
  [[nodiscard]] double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
        .count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// A device without a frame is asked again after this.
constexpr auto kIdle = std::chrono::milliseconds(1);

/// Draws until the queue is closed and empty. After a failure it goes on taking, so that tracking
/// never waits for a drawer that gave up.
void draw_all(SnapshotQueue& queue, SnapshotSink& sink, LoopReport& report, Status& status) {
  while (Snapshot* snapshot = queue.take()) {
    if (status.ok()) {
      const Stopwatch watch;
      status = sink.draw(*snapshot);
      report.draw_wall_ms.push_back(watch.elapsed_ms());
      ++report.drawn;
    }
    queue.release(snapshot);
  }
}

}  // namespace

Result<LoopReport> FrameLoop::run() {
  LoopReport report;
  Status tracked;
  Status drawn;
  if (!sink_ || options_.draw_every <= 0) {
    tracked = loop(nullptr, report);
  } else {
    SnapshotQueue queue(options_.drop_late_snapshots ? SnapshotQueue::WhenFull::kDropOldest
                                                     : SnapshotQueue::WhenFull::kWait);
    LoopReport drawing;
    std::thread drawer([&] { draw_all(queue, *sink_, drawing, drawn); });
    tracked = loop(&queue, report);
    queue.close();
    drawer.join();
    report.drawn = drawing.drawn;
    report.draw_wall_ms = std::move(drawing.draw_wall_ms);
    report.dropped_snapshots = queue.dropped();
  }
  if (!tracked) return tracked.error();
  if (!drawn) return drawn.error();
  report.done = session_.current_step() == Step::kDone;
  return report;
}

Status FrameLoop::loop(SnapshotQueue* queue, LoopReport& report) {
  while (!finished(report)) {
    const auto more = next_frame(report);
    if (!more) return more.error();
    if (!*more) return {};
    if (const Status stepped = step(queue, report); !stepped) return stepped;
  }
  return {};
}

/// False at the end of the stream.
Result<bool> FrameLoop::next_frame(LoopReport& report) {
  while (!stop_) {
    const auto next = headset_.cameras().next(frame_);
    if (!next) {
      ++report.failed_frames;
      report.last_failure = next.error().message;
      if (++errors_in_a_row_ > options_.max_errors_in_a_row)
        return Error{headset_.name() + ": " + std::to_string(errors_in_a_row_) +
                     " pairs in a row failed (limit " +
                     std::to_string(options_.max_errors_in_a_row) + "): " + next.error().message};
      continue;
    }
    errors_in_a_row_ = 0;
    if (*next == Next::kFrame) return true;
    if (*next == Next::kEnd) return false;
    std::this_thread::sleep_for(kIdle);
  }
  return false;
}

Status FrameLoop::step(SnapshotQueue* queue, LoopReport& report) {
  const Stopwatch watch;
  clicks_.clear();
  phrases_.clear();
  if (const Status polled = headset_.clicker().poll(frame_.time, clicks_); !polled) return polled;
  if (const Status polled = headset_.voice().poll(frame_.time, phrases_); !polled) return polled;
  Inputs inputs;
  inputs.clicks = clicks_;
  inputs.phrases = phrases_;
  inputs.display_time = headset_.display().predicted_display_time(frame_.time);
  const Guidance& guidance = session_.step(frame_, inputs);
  if (report.displayed == 0) report.first_frame = frame_.time;
  report.last_frame = frame_.time;
  if (observer_) observer_->stepped(frame_, inputs, guidance);
  builder_.update(guidance);
  if (const Status shown = show(guidance, report); !shown) return shown;
  const std::int64_t frame = report.displayed - 1;
  if (queue && frame % options_.draw_every == 0) capture(*queue, guidance, frame);
  report.step_wall_ms.push_back(watch.elapsed_ms());
  return {};
}

Status FrameLoop::show(const Guidance& guidance, LoopReport& report) {
  builder_.write_shown(guidance, shown_);
  if (const Status shown = headset_.display().shown(shown_); !shown) return shown;
  if (last_display_)
    report.intervals_ms.push_back(seconds(guidance.display_time - *last_display_) * 1e3);
  last_display_ = guidance.display_time;
  ++report.displayed;
  return {};
}

void FrameLoop::capture(SnapshotQueue& queue, const Guidance& guidance, std::int64_t frame) {
  Snapshot* snapshot = queue.acquire();
  if (!snapshot) return;
  snapshot->frame = frame;
  snapshot->display_time = guidance.display_time;
  snapshot->step = guidance.step;
  snapshot->step_text = guidance.step_text;
  const auto head = headset_.head().world_from_rig(guidance.display_time);
  snapshot->world_from_rig.reset();
  if (head.origin != Origin::kLost) snapshot->world_from_rig = head.value;
  builder_.write_scene(guidance, snapshot->scene);
  if (observer_) observer_->captured(*snapshot);
  queue.publish(snapshot);
}

bool FrameLoop::finished(const LoopReport& report) {
  if (stop_) return true;
  if (options_.max_frames > 0 && report.displayed >= options_.max_frames) return true;
  if (session_.current_step() != Step::kDone) return false;
  if (!done_since_) done_since_ = report.last_frame;
  return report.last_frame - *done_since_ >= options_.after_done;
}

}  // namespace orthonav::engine
