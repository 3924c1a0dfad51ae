#include "tools/orthonav/operation/run_files.h"

#include <utility>

#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "tools/orthonav/operation/demo_report.h"

namespace orthonav::tools {

Status joined_errors(const Status& ended, const Status& written) {
  return ended || written ? (ended ? written : ended)
                          : Status(Error{ended.error().message + "; " + written.error().message,
                                         ended.error().code});
}

Status RunFiles::make_folder(const std::string& folder) {
  auto out = OutFolder::create("--out", folder);
  if (!out) {
    return out.error();
  }
  out_.emplace(std::move(*out));
  return {};
}

Status RunFiles::keep(engine::AssembledOperation& operation, const KeptOperation::About& about) {
  return kept_.begin(operation, out_->path().string(), about);
}

Status RunFiles::record(engine::AssembledOperation& operation, const std::string& folder,
                        Headset& headset, const std::vector<nav::ToolGeometry>& tools,
                        EventLog& log) {
  replay::RecorderOptions options;
  options.tools_json = engine::tools_text(tools);
  options.takes_depth = true;
  auto recorder = replay::RecordingHeadset::around(headset, folder, options);
  if (!recorder) {
    return recorder.error();
  }
  recorder_ = std::move(*recorder);
  operation.go_through(*recorder_);
  recording_.emplace(log).watch(operation, *recorder_, kept_.log());
  return {};
}

std::optional<engine::RecordedPairs> RunFiles::end_recording() {
  if (!recorder_) {
    return std::nullopt;
  }
  recorder_->stop();
  const replay::RecordedCounts counts = recorder_->counts();
  return engine::RecordedPairs{counts.pairs, counts.lost_pairs};
}

Status RunFiles::finish(const engine::OperationResult& result, const std::string& report,
                        bool simulated) {
  Status first = kept_.finish(result.completed, result.completed ? "" : result.why_not,
                              result.loop.last_frame);
  const auto note = [&first](const Status& status) {
    if (first.ok()) {
      first = status;
    }
  };
  if (out_) {
    note(engine::write_file(out_->file("report.json"), report));
    note(write_demo_report(out_->path(), result, {.date = kept_.begun(), .simulated = simulated}));
  }
  if (recorder_) {
    note(recorder_->close());
    recording_->ended();
  }
  return first;
}

std::string RunFiles::close(std::string reason) {
  const auto note = [&reason](const Status& status) {
    if (!status) {
      reason += "; " + status.error().message;
    }
  };
  note(kept_.finish(false, reason));
  if (recorder_) {
    note(recorder_->close());
    recording_->ended();
  }
  return reason;
}

}  // namespace orthonav::tools
