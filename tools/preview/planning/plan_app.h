#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "tools/preview/planning/plan_model.h"
#include "tools/preview/planning/plan_panel.h"
#include "tools/preview/planning/plan_view.h"
#include "tools/preview/script.h"
#include "tools/preview/window.h"

namespace orthonav::preview {

struct PlanOptions {
  int width_px = 1120;
  int height_px = 720;
  std::string device;                    ///< part of a Vulkan device's name; empty: the best
  std::string out = "orthonav-preview";  ///< folder of screenshots and plans
  std::string scan_name;                 ///< as the panel shows it; empty: no scan
};

/// The window in which a plan is edited. Main thread.
class PlanApp {
 public:
  /// The editor, and the scan (null: none), must outlive it.
  PlanApp(PlanOptions options, std::optional<Script> script, engine::PlanEditor& editor,
          const engine::Volume* scan);
  Status open_window();
  /// Runs until the user quits or the script has come to its end. However it ends, changes that
  /// were not saved are saved then.
  Status run();
  /// Ends `run` as if the user had quit; from any thread.
  void quit() { quit_ = true; }
  /// The newest saved case; empty: none was saved.
  [[nodiscard]] const std::string& saved() const { return saved_; }

 private:
  Status watch();
  Status run_script();
  Status draw();
  Status save();
  Status take_screenshot(const std::string& name);

  PlanOptions options_;
  std::optional<Script> script_;
  const engine::Volume* scan_;
  std::atomic<bool> quit_ = false;
  bool discard_ = false;
  PlanModel model_;
  PlanFacts facts_;
  std::unique_ptr<PlanView> view_;
  std::unique_ptr<Window> window_;
  std::string wanted_screenshot_;  ///< name of the file; empty: none
  std::string saved_;
};

}  // namespace orthonav::preview
