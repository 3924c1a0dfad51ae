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

/// A device that fails now and then must not end an operation; one that fails for good must.
Status FrameLoop::tolerate(const Status& status, int& in_a_row, LoopReport& report) {
  if (status.ok()) {
    in_a_row = 0;
    return {};
  }
  ++report.failures;
  report.last_failure = status.error().message;
  if (++in_a_row <= options_.max_errors_in_a_row) return {};
  return Error{headset_.name() + ": " + std::to_string(in_a_row) + " failures in a row (limit " +
               std::to_string(options_.max_errors_in_a_row) + "): " + report.last_failure};
}

/// False at the end of the stream.
Result<bool> FrameLoop::next_frame(LoopReport& report) {
  while (!stop_) {
    const auto next = headset_.cameras().next(frame_);
    const Status status = next ? Status{} : Status{next.error()};
    if (const Status over = tolerate(status, camera_errors_, report); !over) return over.error();
    if (!next) continue;
    if (*next == Next::kFrame) return true;
    if (*next == Next::kEnd) return false;
    std::this_thread::sleep_for(kIdle);
  }
  return false;
}

Status FrameLoop::step(SnapshotQueue* queue, LoopReport& report) {
  const Stopwatch watch;
  const Timestamp received = headset_.clock().now();
  clicks_.clear();
  phrases_.clear();
  const Status clicked = headset_.clicker().poll(frame_.time, clicks_);
  if (const Status over = tolerate(clicked, clicker_errors_, report); !over) return over;
  const Status spoken = headset_.voice().poll(frame_.time, phrases_);
  if (const Status over = tolerate(spoken, voice_errors_, report); !over) return over;
  Inputs inputs;
  inputs.clicks = clicks_;
  inputs.phrases = phrases_;
  // What is made of this pair is submitted from here on: the images were underway for a while.
  inputs.display_time = headset_.display().predicted_display_time(received);
  const Guidance& guidance = session_.step(frame_, inputs);
  if (!first_frame_seen_) report.first_frame = frame_.time;
  first_frame_seen_ = true;
  report.last_frame = frame_.time;
  if (observer_) observer_->stepped(frame_, inputs, guidance);
  builder_.update(guidance);
  builder_.write_shown(guidance, shown_);
  const Status shown = headset_.display().shown(shown_);
  if (const Status over = tolerate(shown, display_errors_, report); !over) return over;
  if (shown) count_displayed(guidance, queue, report);
  report.step_wall_ms.push_back(watch.elapsed_ms());
  return {};
}

void FrameLoop::count_displayed(const Guidance& guidance, SnapshotQueue* queue,
                                LoopReport& report) {
  if (last_display_)
    report.intervals_ms.push_back(seconds(guidance.display_time - *last_display_) * 1e3);
  last_display_ = guidance.display_time;
  const std::int64_t frame = report.displayed++;
  if (queue && frame % options_.draw_every == 0) capture(*queue, guidance, frame);
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
