#include "engine/live/frame_loop.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/joined.h"
#include "base/stopwatch.h"

namespace orthonav::engine {
namespace {

/// How long to wait before asking a device again that had no frame.
constexpr auto kNoPairPause = std::chrono::milliseconds(1);

}  // namespace

Result<LoopReport> FrameLoop::run() {
  const std::vector<std::string> problems = options_.check();
  if (!problems.empty()) {
    return Error{"loop: " + joined(problems)};
  }
  LoopReport report;
  Status tracked;
  Status drawn;
  heard_at_ = headset_->clock().now();
  if (!sink_ || options_.draw_every == 0) {
    tracked = loop(nullptr, report);
  } else {
    SnapshotQueue queue(options_.drop_late_snapshots ? SnapshotQueue::WhenFull::kDropOldest
                                                     : SnapshotQueue::WhenFull::kWait);
    LoopReport drawing;
    std::thread drawer([&] { draw_all(queue, drawing, drawn); });
    tracked = loop(&queue, report);
    queue.close();
    drawer.join();
    report.drawn = drawing.drawn;
    report.draw_failures = drawing.failures;
    if (drawing.failures > 0) {
      report.last_failure = drawing.last_failure;
    }
    report.draw_wall_ms = std::move(drawing.draw_wall_ms);
    report.dropped_snapshots = queue.dropped();
  }
  if (!tracked) {
    return tracked.error();
  }
  if (!drawn) {
    return drawn.error();
  }
  report.done = session_.current_step() == Step::kDone;
  return report;
}

/// Draws until the queue is closed and empty. After too many failures in a row it fails for good
/// and stops the loop, since a surgeon who sees nothing must be told. The remaining snapshots are
/// taken without being drawn, so that tracking never waits for a drawer that gave up.
void FrameLoop::draw_all(SnapshotQueue& queue, LoopReport& drawing, Status& status) {
  int in_a_row = 0;
  while (Snapshot* snapshot = queue.take()) {
    // Only in real time: where every snapshot is drawn, the pictures are for later, and the
    // device's clock runs ahead of them.
    if (options_.drop_late_snapshots && snapshot->expires &&
        next_display_time() > *snapshot->expires) {
      hide_tool_guidance(snapshot->scene);
      snapshot->tool_time.reset();
    }
    if (status.ok()) {
      const Stopwatch watch;
      const Status drawn = sink_->draw(*snapshot);
      drawing.draw_wall_ms.push_back(watch.elapsed_ms());
      drawing.drawn += drawn ? 1 : 0;
      status = tolerate(drawn, in_a_row, drawing);
      if (!status) {
        stop();
      }
    }
    queue.release(snapshot);
  }
}

Status FrameLoop::loop(SnapshotQueue* queue, LoopReport& report) {
  const auto run_all = [&]() -> Status {
    while (!finished(report)) {
      const auto more = next_frame(queue, report);
      if (!more) {
        return more.error();
      }
      if (!*more) {
        return {};
      }
      if (const Status stepped = step(queue, report); !stepped) {
        return stepped;
      }
    }
    return {};
  };
  const Status ended = run_all();
  // However it ended: a display that goes on showing its last frame must not go on guiding.
  if (last_display_time_ > Timestamp::min()) {
    take_back(session_.end(next_display_time()), queue, report);
  }
  return ended;
}

/// A device that fails now and then must not end an operation; one that fails for good must.
Status FrameLoop::tolerate(const Status& status, int& in_a_row, LoopReport& report) {
  if (status.ok()) {
    in_a_row = 0;
    return {};
  }
  ++report.failures;
  report.last_failure = status.error().message;
  if (++in_a_row <= options_.max_errors_in_a_row) {
    return {};
  }
  return Error{headset_->name() + ": " + std::to_string(in_a_row) + " failures in a row (limit " +
               std::to_string(options_.max_errors_in_a_row) + "): " + report.last_failure};
}

/// False at the end of the stream. While no pair comes, guidance on the last one is taken back.
Result<bool> FrameLoop::next_frame(SnapshotQueue* queue, LoopReport& report) {
  while (!stop_) {
    const auto next = headset_->cameras().next(frame_);
    if (next && *next == Next::kFrame) {
      camera_errors_ = 0;
      return true;
    }
    if (next && *next == Next::kEnd) {
      return false;
    }
    if (!next) {
      if (const Status over = tolerate(Status(next.error()), camera_errors_, report); !over) {
        return over.error();
      }
    }
    if (const Status waited = wait_for_pair(queue, report); !waited) {
      return waited.error();
    }
  }
  return false;
}

Status FrameLoop::wait_for_pair(SnapshotQueue* queue, LoopReport& report) {
  const Timestamp display_time = next_display_time();
  if (guiding_since_ && display_time - *guiding_since_ > session_.options().stale_after) {
    take_back(session_.expire(display_time), queue, report);
    ++report.blanked;
    guiding_since_.reset();
  }
  const Duration silent = headset_->clock().now() - heard_at_;
  if (silent > options_.longest_silence) {
    return Error{headset_->name() + ": no camera pair for " + std::to_string(seconds(silent)) +
                 " s (limit " + std::to_string(seconds(options_.longest_silence)) + " s)"};
  }
  std::this_thread::sleep_for(kNoPairPause);
  return {};
}

/// The display time of a frame submitted now.
Timestamp FrameLoop::next_display_time() const {
  return headset_->display().predicted_display_time(headset_->clock().now());
}

/// Shows, by the usual way of every frame, guidance that no longer guides. If the display fails
/// here it may keep showing the old frame; all that can be done then is to report it.
void FrameLoop::take_back(const Guidance& guidance, SnapshotQueue* queue, LoopReport& report) {
  builder_.update(guidance);
  builder_.write_shown(guidance, shown_);
  shown_.display_time = std::max(guidance.display_time, last_display_time_ + Duration(1));
  last_display_time_ = shown_.display_time;
  if (const Status shown = headset_->display().shown(shown_); !shown) {
    ++report.failures;
    report.last_failure = shown.error().message;
  }
  if (queue) {
    capture(*queue, guidance, report.displayed);
  }
}

/// Clicks and phrases up to the pair's time.
Status FrameLoop::poll_commands(LoopReport& report) {
  clicks_.clear();
  phrases_.clear();
  const Status clicked = headset_->clicker().poll(frame_.time, clicks_);
  if (const Status over = tolerate(clicked, clicker_errors_, report); !over) {
    return over;
  }
  return tolerate(headset_->voice().poll(frame_.time, phrases_), voice_errors_, report);
}

Status FrameLoop::step(SnapshotQueue* queue, LoopReport& report) {
  const Stopwatch watch;
  heard_at_ = headset_->clock().now();
  if (const Status over = poll_commands(report); !over) {
    return over;
  }
  Inputs inputs;
  inputs.clicks = clicks_;
  inputs.phrases = phrases_;
  // Submitted from now on; the images were under way for a while.
  inputs.display_time = headset_->display().predicted_display_time(heard_at_);
  const Guidance& guidance = session_.step(frame_, inputs);
  report.last_frame = frame_.time;
  if (!first_frame_) {
    first_frame_ = frame_.time;
  }
  for (LoopObserver* observer : observers_) {
    observer->stepped(frame_, inputs, guidance);
  }
  // Tracking took time: guidance that has become too old meanwhile is not shown.
  builder_.update(guidance, std::max(guidance.display_time, next_display_time()));
  builder_.write_shown(guidance, shown_);
  const Status shown = headset_->display().shown(shown_);
  report.step_wall_ms.push_back(watch.elapsed_ms());
  if (const Status over = tolerate(shown, display_errors_, report); !over) {
    return over;
  }
  guiding_since_ = frame_.time;
  last_display_time_ = std::max(last_display_time_, shown_.display_time);
  if (shown) {
    count_displayed(guidance, queue, report);
  }
  return {};
}

void FrameLoop::count_displayed(const Guidance& guidance, SnapshotQueue* queue,
                                LoopReport& report) {
  if (last_display_) {
    report.intervals_ms.push_back(seconds(guidance.display_time - *last_display_) * 1e3);
  }
  last_display_ = guidance.display_time;
  report.photon_ages_ms.push_back(seconds(guidance.display_time - guidance.frame_time) * 1e3);
  const std::int64_t frame = report.displayed++;
  if (queue && frame % options_.draw_every == 0) {
    capture(*queue, guidance, frame);
  }
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

bool FrameLoop::finished(const LoopReport& report) {
  if (stop_) {
    return true;
  }
  if (options_.max_frames > 0 && report.displayed >= options_.max_frames) {
    return true;
  }
  if (options_.max_time > Duration::zero() && first_frame_ &&
      report.last_frame - *first_frame_ >= options_.max_time) {
    return true;
  }
  if (session_.current_step() != Step::kDone) {
    return false;
  }
  if (!done_since_) {
    done_since_ = report.last_frame;
  }
  return report.last_frame - *done_since_ >= options_.after_done;
}

}  // namespace orthonav::engine
