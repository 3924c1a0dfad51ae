#pragma once

#include <string>

#include "engine/live/frame_loop.h"
#include "tools/progress_bar.h"

namespace orthonav::tools {

/// Progress of an operation on standard error: a bar with an estimate of the time left on a
/// terminal, otherwise a plain line at each step of the workflow.
class OperationProgress : public engine::LoopObserver {
 public:
  /// Also passes on what it hears. `next` is borrowed and may be null.
  explicit OperationProgress(engine::LoopObserver* next) : next_(next) {}
  void stepped(const StereoFrame& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  void captured(const engine::Snapshot& snapshot) override;

 private:
  engine::LoopObserver* next_;
  ProgressBar bar_;
  std::optional<StepOnDisplay> step_;
  Timestamp first_{};
};

/// Progress of an operation, in [0, 1]: digitizing makes up much of a level, a screw a part.
[[nodiscard]] double fraction_done(const engine::Guidance& guidance);

}  // namespace orthonav::tools
