#pragma once

#include <optional>
#include <string>

#include "base/stopwatch.h"
#include "engine/live/frame_loop.h"
#include "tools/orthonav/operation/operation_estimate.h"
#include "tools/orthonav/shared/progress_bar.h"

namespace orthonav::tools {

/// Progress of an operation (ProgressBar); each step of the workflow is shown at once.
class OperationProgress : public engine::LoopObserver {
 public:
  void stepped(const FrameHeader& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  void withdrawn(const engine::Guidance& guidance) override;
  void cameras_failed(const std::string& why) override;
  void input_failed(const std::string& why) override;
  /// The operation has ended: its line is cleared.
  void end() {
    bar_.end();
    tell_untold();
  }

 private:
  /// One that repeats is printed once, then how often it came.
  void warn(const std::string& why);
  void tell_untold();

  ProgressBar bar_;
  OperationEstimate estimate_;
  std::optional<engine::StepOnDisplay> step_;
  std::optional<Stopwatch> cameras_warned_;
  std::string warned_;
  int untold_ = 0;
};

}  // namespace orthonav::tools
