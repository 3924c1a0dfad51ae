#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "engine/live/display_renderer.h"
#include "engine/live/frame_loop.h"
#include "hal/api/pixel_display.h"

namespace orthonav::engine {

/// What was put before the surgeon's eyes.
struct PresentReport {
  std::int64_t frames = 0;  ///< that the display asked for
  std::int64_t drawn = 0;
  std::int64_t hidden = 0;  ///< snapshots whose guidance had grown too old before it was drawn
  std::int64_t losses = 0;  ///< of the session or the runtime; each with its line in `problems`
  std::int64_t failures = 0;
  std::vector<std::string> problems;  ///< the first few, one line each
  /// Wall time from asking for the head's pose until the device has its orders.
  std::vector<double> latch_ms;
};

struct PresenterOptions {
  render::RendererOptions renderer;
  /// How long to wait, by the wall, before a display that went away is looked for again.
  Duration look_again_after = std::chrono::seconds(1);
  /// Called on the presenting thread once the user has ended the session.
  std::function<void()> on_over;
  /// Called on the presenting thread with every scene that was drawn and its views, left first.
  std::function<void(const render::Scene&, const std::vector<render::View>&)> on_drawn;
};

/// Draws the newest snapshot again and again as the display asks for frames, in a thread of its
/// own, each time for where the head is then. A display that goes away is looked for again;
/// meanwhile tracking goes on.
class Presenter : public SnapshotSink {
 public:
  /// An Error when the display can't be opened. `display` must outlive it.
  static Result<std::unique_ptr<Presenter>> start(PixelDisplay& display, PresenterOptions options);
  ~Presenter() override;
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// Shows it from the next frame on. An Error tells of what went wrong since the last call, once.
  Status draw(const Snapshot& snapshot) override;
  /// Ends the session in order; nothing is shown from here on.
  PresentReport stop();

 private:
  Presenter(PixelDisplay& display, PresenterOptions options)
      : display_(display), options_(std::move(options)) {}

  void run();
  void take_turn();
  void present(const DisplayFrame& turn);
  bool draw_scene(const DisplayFrame& turn);
  void look_again();
  void leave();
  void lose(const std::string& why);
  void note(const std::string& problem);
  /// Returns early when stopped.
  void pause(Duration by_the_wall);

  PixelDisplay& display_;
  PresenterOptions options_;
  std::thread thread_;

  // Under the mutex.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  Snapshot incoming_;
  bool fresh_ = false;
  PresentReport report_;
  std::string untold_;  ///< the last problem that `draw` has not told yet

  // Of the presenting thread.
  std::unique_ptr<DisplayRenderer> renderer_;
  Snapshot shown_;
  bool has_snapshot_ = false;
  bool over_ = false;
};

}  // namespace orthonav::engine
