#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/histogram.h"
#include "engine/holograms/scene_builder.h"
#include "engine/live/heartbeats.h"
#include "engine/live/snapshot_queue.h"
#include "engine/session/session.h"
#include "hal/api/devices.h"
#include "hal/api/tool_pose_source.h"

namespace orthonav::engine {

/// Observes, on the tracking thread, the inputs of every stereo pair (or of every moment at which
/// the device measured tools itself) and the results.
class LoopObserver {
 public:
  virtual ~LoopObserver() = default;
  /// The stereo pair, before it is processed; valid until the next one.
  virtual void pair_came(const StereoFrame& /*pair*/) {}
  virtual void stepped(const FrameHeader& /*frame*/, const Inputs& /*inputs*/,
                       const Guidance& /*guidance*/) {}
  /// What is on display from its display time on; every frame is shown, also when it takes back.
  virtual void shown(const ShownFrame& /*frame*/) {}
  /// The cameras delivered an error, and the reason differs from the last one.
  virtual void cameras_failed(const std::string& /*why*/) {}
  /// No pair guides any more: the guidance of the last one was withdrawn, or it is told why again.
  virtual void withdrawn(const Guidance& /*guidance*/) {}
  /// A snapshot was filled and is about to go to the rendering thread.
  virtual void captured(const Snapshot& /*snapshot*/) {}
  /// The tracking thread hangs in that part; called once per stall, on the rendering thread, if
  /// snapshots are drawn in real time.
  virtual void part_stalled(Part /*part*/) {}
  /// The clicker or the voice failed, or is not there; called once per failure.
  virtual void input_failed(const std::string& /*why*/) {}
};

/// Draws snapshots, on the rendering thread.
class SnapshotSink {
 public:
  virtual ~SnapshotSink() = default;
  virtual Status draw(const Snapshot& snapshot) = 0;
  /// Whether it draws on a thread of its own and that thread hangs. Callable from any thread.
  [[nodiscard]] virtual bool stalled() const { return false; }
  /// Where the wearer looks; absent if that is unknown. Callable from any thread.
  [[nodiscard]] virtual std::optional<Gaze> gaze() const { return std::nullopt; }
};

/// A part that works on one thing for longer than this has stalled; it is named within half a
/// second.
inline constexpr Duration kStallAfter = std::chrono::milliseconds(400);

struct LoopOptions {
  /// Every n-th displayed frame goes to the sink; 0: none. Counted, not timed, so that the same
  /// frames are drawn regardless of the machine's speed.
  int draw_every = 1;
  /// Of these, every n-th while no screw is guided, and the first of each step.
  int unguided_every = 1;
  /// Whether the device's clock runs by itself. Then only the newest snapshot is drawn, tracking
  /// never waits, and stalled threads are noticed. Otherwise pairs advance the clock: every
  /// snapshot is drawn, and the speed of drawing has no effect.
  bool real_time = false;
  std::int64_t max_frames = 0;  ///< ends after this many displayed frames; 0: no limit
  /// Ends once this much of the device's clock has passed since the first pair, though no more
  /// pairs come; 0: no limit. Without any pair in this time the cameras count as gone for good.
  Duration max_time = Duration::zero();
  int max_errors_in_a_row = 30;  ///< of one device or the sink; beyond it the run ends
  /// Cameras that deliver nothing for this long, by the device's clock, count as gone for good.
  Duration longest_silence = std::chrono::seconds(60);

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// What the loop measured. Times of the device's clock are part of the result; wall times depend on
/// the machine.
struct LoopReport {
  /// Why it ended, if a device or the sink failed for good, a thread died, or an option is invalid.
  /// All else is what was measured until then.
  Status ended;
  std::int64_t displayed = 0;
  std::int64_t failures = 0;  ///< of any device, with the reason of the last
  std::string last_failure;
  std::int64_t blanked = 0;   ///< times that guidance was removed because pairs stopped
  std::int64_t repeated = 0;  ///< pairs not used since a picture or the head's pose repeats
  std::int64_t stalls = 0;    ///< times that guidance was hidden because a part stalled
  std::int64_t drawn = 0;
  std::int64_t draw_failures = 0;  ///< of the sink; each with its reason in `last_failure`
  std::int64_t dropped_snapshots = 0;
  bool done = false;  ///< the workflow reached its end
  Timestamp last_frame{};
  Histogram intervals_ms;  ///< device clock, between displayed frames
  /// Device clock, from the middle of a pair's exposure until its display time: capture to
  /// photon.
  Histogram photon_ages_ms;
  /// Wall time of tracking and everything after it, per pair, without waiting for the drawing.
  Histogram step_wall_ms;
  Histogram draw_wall_ms;  ///< wall time of the sink, per snapshot
};

/// From stereo pairs, or from poses of tools where the device measures them itself, to the display:
/// tracking on the calling thread, drawing on a separate thread.
/// Drawing only takes snapshots, so it can't influence a result; only if it stalls, by the device's
/// clock, is guidance hidden. An exception in either thread ends the run in an orderly way, with an
/// Error that names the part.
class FrameLoop {
 public:
  FrameLoop(Headset& headset, Session& session, SceneBuilder& builder, const LoopOptions& options)
      : headset_(&headset), session_(session), builder_(builder), options_(options) {}

  /// Replaces the headset; not while it runs.
  void use(Headset& headset) { headset_ = &headset; }
  /// Adds an observer, called after those added before; null is ignored. Borrowed.
  void observe(LoopObserver* observer) {
    if (observer != nullptr) {
      observers_.push_back(observer);
    }
  }
  void draw_into(SnapshotSink* sink) { sink_ = sink; }
  /// Requests from other programs, in addition to clicker and voice; null: none. Borrowed.
  void hear(Requests* requests) { requests_ = requests; }
  /// Ends the run early, from any thread.
  void stop() { stop_ = true; }

  /// Runs until the stream ends, the operation is done, or the limit is reached; see
  /// `LoopReport::ended` for what else can end it. However it ends, the last frame shown contains
  /// no guidance.
  [[nodiscard]] LoopReport run();

 private:
  Status loop(SnapshotQueue* queue, LoopReport& report);
  Status loop_until_over(SnapshotQueue* queue, LoopReport& report);
  [[nodiscard]] std::optional<Part> stalled() const;
  void count_stall(std::optional<Part> now, LoopReport& report);
  Result<bool> next_frame(SnapshotQueue* queue, LoopReport& report);
  Result<Next> pull();
  /// The newest pair or poses.
  [[nodiscard]] const FrameHeader& newest() const;
  Status wait_for_pair(SnapshotQueue* queue, LoopReport& report);
  void take_back(const Guidance& guidance, SnapshotQueue* queue, LoopReport& report);
  void show();
  [[nodiscard]] Timestamp next_display_time();
  // frame_loop_drawing.cpp
  Status loop_and_draw(LoopReport& report);
  [[nodiscard]] Timestamp lights_up() const;
  Status draw_all(SnapshotQueue& queue, LoopReport& drawing);
  Status draw_into_sink(const Snapshot& snapshot);
  void warn_of_stall(const Snapshot* last, std::optional<Part>& warned, LoopReport& drawing);
  Snapshot* await_snapshot(SnapshotQueue& queue, Snapshot* last, LoopReport& drawing);
  Status poll_commands(LoopReport& report);
  Status step(SnapshotQueue* queue, LoopReport& report);
  Status tolerate(const Status& status, int& in_a_row, LoopReport& report);
  void count_displayed(const Guidance& guidance, SnapshotQueue* queue, LoopReport& report);
  void capture(SnapshotQueue& queue, const Guidance& guidance, std::int64_t frame);
  [[nodiscard]] bool finished(const LoopReport& report, Timestamp reached);

  Headset* headset_;
  Session& session_;
  SceneBuilder& builder_;
  LoopOptions options_;
  std::vector<LoopObserver*> observers_;
  SnapshotSink* sink_ = nullptr;
  Requests* requests_ = nullptr;
  std::atomic<bool> stop_ = false;
  /// From submitting a frame until it lights up, as the display last said. A display is asked on
  /// the tracking thread alone, and the drawing thread goes by this: it must know what is too old
  /// while the tracking thread hangs.
  std::atomic<Duration::rep> ahead_ns_ = 0;

  std::optional<Heartbeats> beats_;  ///< while it runs
  std::optional<Part> stalled_;      ///< at the last pair
  bool voice_stalled_ = false;
  bool no_clicker_ = false;

  // Reused from pair to pair.
  StereoFrame frame_;
  ToolPoses poses_;  ///< in place of pairs, if the headset measures tools itself
  std::vector<ClickerEvent> clicks_;
  std::vector<Phrase> phrases_;
  std::vector<Request> asked_;
  ShownFrame shown_;
  std::optional<Timestamp> last_display_;           ///< of a pair's frame, for the intervals
  Timestamp last_display_time_ = Timestamp::min();  ///< of any frame
  Timestamp heard_at_{};                    ///< when the last pair arrived, or the loop began
  Timestamp alive_at_{};                    ///< the same, or when an old pair came again
  std::optional<Timestamp> guiding_since_;  ///< mid-exposure of the pair that is being shown
  std::optional<Repeated> repeats_;         ///< in every pair since the last good one
  std::optional<Repeated> told_repeats_;    ///< to the wearer, when guidance was withdrawn
  std::optional<Timestamp> done_since_;
  std::optional<StepOnDisplay> drawn_step_;
  std::optional<Timestamp> first_frame_;  ///< mid-exposure of the first pair
  int camera_errors_ = 0;                 ///< in a row, each
  int clicker_errors_ = 0;
  int voice_errors_ = 0;
};

}  // namespace orthonav::engine
