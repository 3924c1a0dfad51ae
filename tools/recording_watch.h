#pragma once

#include <string>

#include "engine/live/assembled_operation.h"
#include "hal/replay/recorder.h"
#include "tools/event_log.h"

namespace orthonav::tools {

/// Reports at once if the recording of a running operation has stopped: on its status line, in its
/// log and on standard error.
class RecordingWatch : public engine::SaveWatch, public engine::LoopObserver {
 public:
  /// `log` must outlive it.
  explicit RecordingWatch(EventLog& log) : log_(log) {}
  /// Starts watching. `saving` is the status line's source for saving until then; may be null. All
  /// must outlive the operation's run.
  void watch(engine::AssembledOperation& operation, const replay::RecordingHeadset& recorder,
             const engine::SaveWatch* saving);

  [[nodiscard]] engine::Saved saved(Timestamp now, Duration lately) const override;
  void stepped(const StereoFrame& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;

 private:
  EventLog& log_;
  const replay::RecordingHeadset* recorder_ = nullptr;
  const engine::SaveWatch* saving_ = nullptr;
  bool told_ = false;
};

}  // namespace orthonav::tools
