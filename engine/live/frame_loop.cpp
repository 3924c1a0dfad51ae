#include "engine/live/frame_loop.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/guarded.h"
#include "base/joined.h"
#include "base/stopwatch.h"
#include "engine/session/work_watch.h"

namespace orthonav::engine {
namespace {

/// How long to wait before asking a device again that had no frame.
constexpr auto kNoPairPause = std::chrono::milliseconds(1);

}  // namespace

LoopReport FrameLoop::run() {
  LoopReport report;
  const std::vector<std::string> problems = options_.check();
  if (!problems.empty()) {
    report.ended = Error{"loop: " + joined(problems)};
    return report;
  }
  heard_at_ = alive_at_ = headset_->clock().now();
  beats_.emplace(headset_->clock(), kStallAfter);
  session_.watch_work(&*beats_);
  const bool draws = sink_ && options_.draw_every > 0;
  report.ended = draws ? loop_and_draw(report) : loop(nullptr, report);
  session_.watch_work(nullptr);
  report.done = session_.current_step() == Step::kDone;
  return report;
}

Status FrameLoop::loop(SnapshotQueue* queue, LoopReport& report) {
  Status ended;
  try {
    ended = loop_until_over(queue, report);
  } catch (...) {
    ended = ended_by_exception(std::string(word_of(beats_->tracking().value_or(Part::kTracker))));
  }
  // However the loop ended, a display that keeps showing its last frame must not keep guiding.
  const Status taken_back = guarded("tracker", [&] {
    if (last_display_time_ > Timestamp::min()) {
      take_back(session_.end(next_display_time()), queue, report);
    }
  });
  return ended ? taken_back : ended;
}

Status FrameLoop::loop_until_over(SnapshotQueue* queue, LoopReport& report) {
  while (!finished(report, report.last_frame)) {
    const auto more = next_frame(queue, report);
    if (!more) {
      return more.error();
    }
    if (!*more) {
      return {};
    }
    const Working working(&*beats_, Part::kTracker);
    if (const Status stepped = step(queue, report); !stepped) {
      return stepped;
    }
  }
  return {};
}

/// Occasional failures of a device must not end an operation; a permanent one must.
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
                   std::to_string(options_.max_errors_in_a_row) + "): " + report.last_failure,
               status.error().code};
}

Result<Next> FrameLoop::pull() {
  if (ToolPoseSource* const source = headset_->tool_poses()) {
    return source->next(poses_);
  }
  return headset_->cameras()->next(frame_);
}

const FrameHeader& FrameLoop::newest() const {
  if (headset_->tool_poses() != nullptr) {
    return poses_;
  }
  return frame_;
}

/// False at the end of the stream. While no pair comes, guidance on the last one is taken back.
Result<bool> FrameLoop::next_frame(SnapshotQueue* queue, LoopReport& report) {
  // While no pair comes, time passes all the same.
  while (!finished(report, report.last_frame + (headset_->clock().now() - heard_at_))) {
    const auto next = [&] {
      const Working working(&*beats_, Part::kCamera);
      return pull();
    }();
    if (next && *next == Next::kFrame) {
      camera_errors_ = 0;
      repeats_.reset();
      return true;
    }
    if (next && *next == Next::kEnd) {
      return false;
    }
    if (!next && frame_.repeats) {
      // The device is there, and may go on at any time: no failure that ends an operation.
      ++report.repeated;
      repeats_ = frame_.repeats;
      alive_at_ = headset_->clock().now();
    } else if (!next) {
      if (next.error().message != report.last_failure) {
        for (LoopObserver* observer : observers_) {
          observer->cameras_failed(next.error().message);
        }
      }
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
  const Duration silent = headset_->clock().now() - alive_at_;
  if (silent > kStallAfter) {
    repeats_.reset();  // not even old pairs come any more
  }
  if (guiding_since_ && display_time - *guiding_since_ > session_.options().stale_after) {
    take_back(session_.expire(display_time, repeats_), queue, report);
    ++report.blanked;
    guiding_since_.reset();
    told_repeats_ = repeats_;
  } else if (!guiding_since_ && report.blanked > 0 && told_repeats_ != repeats_) {
    take_back(session_.expire(display_time, repeats_), queue, report);
    told_repeats_ = repeats_;
  }
  const bool none_within = !first_frame_ && options_.max_time > Duration::zero();
  const Duration limit = none_within ? std::min(options_.longest_silence, options_.max_time)
                                     : options_.longest_silence;
  if (silent > limit) {
    return Error{headset_->name() + ": no camera pair for " + std::to_string(seconds(silent)) +
                 " s (limit " + std::to_string(seconds(limit)) + " s)" +
                 (report.last_failure.empty() ? "" : "; " + report.last_failure)};
  }
  std::this_thread::sleep_for(kNoPairPause);
  return {};
}

/// The display time of a frame submitted now.
Timestamp FrameLoop::next_display_time() {
  const Timestamp now = headset_->clock().now();
  const Duration latency = headset_->display_latency();
  ahead_ns_ = latency.count();
  return now + latency;
}

void FrameLoop::show() {
  last_display_time_ = std::max(last_display_time_, shown_.display_time);
  for (LoopObserver* observer : observers_) {
    observer->shown(shown_);
  }
}

/// Shows, in the same way as every frame, guidance that no longer guides.
void FrameLoop::take_back(const Guidance& guidance, SnapshotQueue* queue, LoopReport& report) {
  for (LoopObserver* observer : observers_) {
    observer->withdrawn(guidance);
  }
  builder_.update(guidance);
  builder_.write_shown(guidance, shown_);
  shown_.display_time = std::max(guidance.display_time, last_display_time_ + Duration(1));
  show();
  if (queue) {
    capture(*queue, guidance, report.displayed);
  }
}

/// Clicks and phrases up to the pair's time.
Status FrameLoop::poll_commands(LoopReport& report) {
  clicks_.clear();
  phrases_.clear();
  asked_.clear();
  const Timestamp until = newest().time;
  if (requests_ != nullptr) {
    requests_->take(until, asked_);
  }
  const auto tell_of = [&](const Status& failed, int before) {
    for (LoopObserver* observer : observers_) {
      if (!failed && before == 0) {
        observer->input_failed(failed.error().message);
      }
    }
  };
  const Status clicked = headset_->clicker().poll(until, clicks_);
  tell_of(clicked, no_clicker_ ? 1 : clicker_errors_);
  // One that is not there now may come back: the status line says so meanwhile.
  const bool was_away = no_clicker_;
  no_clicker_ = !clicked && clicked.error().code == ErrorCode::kUnavailable;
  if (no_clicker_ && !was_away) {
    ++report.failures;
    report.last_failure = clicked.error().message;
  }
  if (const Status over = no_clicker_ ? Status{} : tolerate(clicked, clicker_errors_, report);
      !over) {
    return over;
  }
  const Working working(&*beats_, Part::kVoice);
  const Status heard = headset_->voice().poll(until, phrases_);
  voice_stalled_ = !heard && heard.error().code == ErrorCode::kUnavailable;
  if (voice_stalled_) {
    return {};
  }
  tell_of(heard, voice_errors_);
  return tolerate(heard, voice_errors_, report);
}

/// The hanging part outside this thread, if any.
std::optional<Part> FrameLoop::stalled() const {
  if (voice_stalled_) {
    return Part::kVoice;
  }
  if (sink_ && sink_->stalled()) {
    return Part::kRenderer;
  }
  // A clock that only pairs advance can't time other threads: they would be late at random, and a
  // simulation would depend on the machine's speed.
  if (sink_ && options_.real_time && beats_->drawing_stalled()) {
    return Part::kRenderer;
  }
  return options_.real_time || headset_->clock().runs_by_itself() ? beats_->stalled_beside()
                                                                  : std::nullopt;
}

void FrameLoop::count_stall(std::optional<Part> now, LoopReport& report) {
  report.stalls += now && now != stalled_ ? 1 : 0;
  stalled_ = now;
}

Status FrameLoop::step(SnapshotQueue* queue, LoopReport& report) {
  const Stopwatch watch;
  heard_at_ = alive_at_ = headset_->clock().now();
  if (const Status over = poll_commands(report); !over) {
    return over;
  }
  Inputs inputs;
  inputs.clicks = clicks_;
  inputs.phrases = phrases_;
  inputs.requests = asked_;
  inputs.stalled = stalled();
  inputs.time_runs = headset_->clock().runs_by_itself();
  inputs.no_clicker = no_clicker_;
  count_stall(inputs.stalled, report);
  // A frame will be submitted from now on; the images took a while to arrive.
  inputs.display_time = heard_at_ + headset_->display_latency();
  const bool measures_tools = headset_->tool_poses() != nullptr;
  if (!measures_tools) {
    for (LoopObserver* observer : observers_) {
      observer->pair_came(frame_);
    }
  }
  const Guidance& guidance =
      measures_tools ? session_.step(poses_, inputs) : session_.step(frame_, inputs);
  const FrameHeader& frame = newest();
  report.last_frame = frame.time;
  if (!first_frame_) {
    first_frame_ = frame.time;
  }
  for (LoopObserver* observer : observers_) {
    observer->stepped(frame, inputs, guidance);
  }
  // Tracking took time: guidance that has become too old meanwhile is not shown.
  builder_.look_at(sink_ ? sink_->gaze() : std::nullopt);
  builder_.update(guidance, std::max(guidance.display_time, next_display_time()));
  builder_.write_shown(guidance, shown_);
  show();
  report.step_wall_ms.add(watch.elapsed_ms());
  guiding_since_ = frame.time;
  count_displayed(guidance, queue, report);
  return {};
}

void FrameLoop::count_displayed(const Guidance& guidance, SnapshotQueue* queue,
                                LoopReport& report) {
  if (last_display_) {
    report.intervals_ms.add(seconds(guidance.display_time - *last_display_) * 1e3);
  }
  last_display_ = guidance.display_time;
  report.photon_ages_ms.add(seconds(guidance.display_time - guidance.frame_time) * 1e3);
  const std::int64_t frame = report.displayed++;
  const bool often = guidance.step == Step::kGuide || drawn_step_ != guidance.status.at;
  const int every = options_.draw_every * (often ? 1 : options_.unguided_every);
  if (queue && frame % every == 0) {
    drawn_step_ = guidance.status.at;
    capture(*queue, guidance, frame);
  }
}

/// Whether the run is over, the device's clock having reached this time.
bool FrameLoop::finished(const LoopReport& report, Timestamp reached) {
  if (stop_) {
    return true;
  }
  if (options_.max_frames > 0 && report.displayed >= options_.max_frames) {
    return true;
  }
  if (options_.max_time > Duration::zero() && first_frame_ &&
      reached - *first_frame_ >= options_.max_time) {
    return true;
  }
  if (session_.current_step() != Step::kDone) {
    return false;
  }
  if (!done_since_) {
    done_since_ = report.last_frame;
  }
  constexpr Duration kAfterDone = std::chrono::seconds(1);  // the last hologram is seen
  return reached - *done_since_ >= kAfterDone;
}

}  // namespace orthonav::engine
