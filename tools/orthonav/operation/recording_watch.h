#pragma once

#include <string>

#include "engine/live/assembled_operation.h"
#include "hal/replay/recorder.h"
#include "tools/orthonav/operation/event_log.h"

namespace orthonav::tools {

/// Reports at once if the recording of a running operation has stopped: on its status line, in its
/// log and on standard error. Pairs that a slow disk lost are told in the log and on standard
/// error: when the first is lost, and how many at the end.
class RecordingWatch : public engine::SaveWatch, public engine::LoopObserver {
 public:
  /// `log` must outlive it.
  explicit RecordingWatch(EventLog& log) : log_(log) {}
  /// Starts watching. `saving` is the status line's source for saving until then; may be null. All
  /// must outlive the operation's run.
  void watch(engine::AssembledOperation& operation, const replay::RecordingHeadset& recorder,
             const engine::SaveWatch* saving);

  /// The recording is closed.
  void ended();

  [[nodiscard]] engine::Saved saved(Timestamp now, Duration lately) const override;
  void stepped(const FrameHeader& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;

 private:
  void warn(const std::string& line);

  EventLog& log_;
  const replay::RecordingHeadset* recorder_ = nullptr;
  const engine::SaveWatch* saving_ = nullptr;
  bool told_ = false;
  bool told_losses_ = false;
};

}  // namespace orthonav::tools
