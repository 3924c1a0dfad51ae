#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/histogram.h"
#include "base/mutex.h"
#include "engine/holograms/labels/label_layout.h"
#include "engine/live/display_renderer.h"
#include "engine/live/frame_loop.h"
#include "hal/api/pixel_display.h"

namespace orthonav::engine {

/// Statistics of the frames shown to the surgeon.
struct PresentReport {
  std::int64_t frames = 0;  ///< frames that the display asked for
  std::int64_t drawn = 0;
  std::int64_t hidden = 0;  ///< snapshots whose guidance was too old by the time it was drawn
  std::int64_t losses = 0;  ///< of session, runtime or device; each with its line in `problems`
  std::int64_t failures = 0;
  std::int64_t late = 0;              ///< frames submitted after their display time
  std::int64_t missed = 0;            ///< display periods without a frame
  std::int64_t panel_draws = 0;       ///< times the status line's panel was drawn
  Duration period{};                  ///< of the display, as last predicted
  std::vector<std::string> problems;  ///< the first few, one line each
  /// Wall time from asking for the head's pose until the frame is submitted to the device.
  Histogram latch_ms;
  // Wall times of each frame: waiting until the display begins it, and submitting it.
  Histogram wait_ms;
  Histogram submit_ms;
};

struct PresenterOptions {
  render::RendererOptions renderer;
  /// The device's clock, by which `stalled` detects that the presenting thread hangs. Null: not
  /// detected.
  const Clock* clock = nullptr;
  /// Wall time to wait before looking again for a lost display.
  Duration look_again_after = std::chrono::seconds(1);
  /// Called on the presenting thread once the user has ended the session.
  std::function<void()> on_over;
  /// Called on the presenting thread with every scene that was drawn and its views, left first.
  std::function<void(const render::Scene&, const std::vector<render::View>&)> on_drawn;
};

/// Draws the newest snapshot for every frame that the display asks for, on a separate thread and
/// for the head's newest pose. A lost display is looked for again while tracking continues.
class Presenter : public SnapshotSink {
 public:
  /// An Error when the display can't be opened. `display` must outlive it.
  static Result<std::unique_ptr<Presenter>> start(PixelDisplay& display, PresenterOptions options);
  ~Presenter() override;
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// Shows it from the next frame on. An Error is the last problem since the previous call; each is
  /// reported once.
  Status draw(const Snapshot& snapshot) override;
  [[nodiscard]] bool stalled() const override { return beats_ && beats_->drawing_stalled(); }
  [[nodiscard]] std::optional<Gaze> gaze() const override;
  /// Ends the session in order; nothing is shown after that.
  PresentReport stop();

 private:
  Presenter(PixelDisplay& display, PresenterOptions options)
      : display_(display), options_(std::move(options)) {
    if (options_.clock) {
      beats_.emplace(*options_.clock, kStallAfter);
    }
  }

  void run();
  void next_frame();
  void present(const DisplayFrame& frame, double waited_ms);
  void note_panel();
  void take_newest();
  bool draw_scene(const DisplayFrame& frame);
  void look_again();
  void leave();
  void lose(const std::string& why);
  void note(const std::string& problem);
  /// Returns early once `stop` was called.
  void pause(Duration wall_time);

  PixelDisplay& display_;
  PresenterOptions options_;
  std::optional<Heartbeats> beats_;
  std::thread thread_;

  mutable Mutex mutex_;
  ConditionVariable changed_;
  bool stopping_ ORTHONAV_GUARDED_BY(mutex_) = false;
  Snapshot incoming_ ORTHONAV_GUARDED_BY(mutex_);
  bool fresh_ ORTHONAV_GUARDED_BY(mutex_) = false;
  PresentReport report_ ORTHONAV_GUARDED_BY(mutex_);
  /// The last problem, if `draw` has not reported it yet.
  std::string untold_ ORTHONAV_GUARDED_BY(mutex_);
  Status died_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Gaze> gaze_ ORTHONAV_GUARDED_BY(mutex_);

  // Used by the presenting thread only.
  std::unique_ptr<DisplayRenderer> renderer_;
  Snapshot shown_;
  bool has_snapshot_ = false;
  LabelLayout labels_;
  std::int64_t panel_draws_ = 0;  ///< of this renderer, already reported
  std::string panel_problem_;     ///< already reported
  bool over_ = false;
};

}  // namespace orthonav::engine
