#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/wall_clock.h"
#include "engine/io/video_writer.h"
#include "tools/preview/live_operation.h"
#include "tools/preview/model.h"
#include "tools/preview/panel.h"
#include "tools/preview/script.h"
#include "tools/preview/stage_view.h"
#include "tools/preview/window.h"

namespace orthonav::preview {

struct PreviewOptions {
  sim::SimOptions room;  ///< of a simulated room
  StageOptions stage;
  std::string out = "orthonav-preview";  ///< folder of screenshots and videos
  bool paused = false;                   ///< from the first pair on
  double speed = 1.0;                    ///< 0: as fast as possible
};

/// The window, the operation in it, and everything in between. Main thread.
class PreviewApp {
 public:
  PreviewApp(PreviewOptions options, std::optional<Script> script);
  /// Called before the operation is prepared, which takes a while and is useless without a display.
  Status open_window();
  Status open_operation(OperationSource source);
  /// Runs until the user quits or the script has come to its end.
  Status run();
  /// Ends `run` as if the user had quit; from any thread.
  void quit() { quit_ = true; }

 private:
  Status start_operation();
  Status watch();
  Status run_script();
  Status show_moment();
  void set_title(const Moment& moment);
  Status grant(const Wishes& wishes);
  Status start_again();
  Status take_screenshot(const std::string& name);
  Status toggle_video();
  Status stop_video();
  Status make_out();
  void count_pictures();
  [[nodiscard]] std::string next_name(const std::string& ending) const;

  PreviewOptions options_;
  std::optional<Script> script_;
  std::atomic<bool> quit_ = false;
  WallClock wall_;
  Gate gate_{wall_};
  Keyboard keyboard_;
  Timeline timeline_;
  PreviewModel model_{gate_, keyboard_, timeline_};
  OperationSource source_;
  std::unique_ptr<StageView> stage_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<LiveOperation> operation_;
  std::unique_ptr<engine::VideoWriter> video_;
  std::string video_name_;
  PanelFacts facts_;
  sim::ErrorModel error_model_;  ///< of the next start
  sim::ErrorModel running_;
  std::string wanted_screenshot_;  ///< name of the file; empty: none
  std::shared_ptr<const Moment> drawn_;
  Look drawn_look_;
  RgbaImage frame_;
  Timestamp counted_since_{};
  int counted_ = 0;
};

}  // namespace orthonav::preview
