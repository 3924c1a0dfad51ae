#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/report/operation_result.h"
#include "hal/replay/recorder.h"
#include "nav/tracking/tool.h"
#include "tools/orthonav/operation/kept_operation.h"
#include "tools/orthonav/operation/recording_watch.h"
#include "tools/orthonav/shared/out_folder.h"

namespace orthonav::tools {

/// In one line: why the run ended, and what of it could not be written.
[[nodiscard]] Status joined_errors(const Status& ended, const Status& written);

/// The files that `run` writes: log and reports in one folder, a recording in another, each only if
/// requested.
class RunFiles {
 public:
  Status make_folder(const std::string& folder);
  /// The operation to be resumed, which is looked for before anything else.
  [[nodiscard]] KeptOperation& kept() { return kept_; }
  /// Begins the log of the operation in that folder, or resumes the one found.
  Status keep(engine::AssembledOperation& operation, const KeptOperation::About& about);
  /// Routes the operation through a recorder of `headset`; all arguments, including `log`, must
  /// outlive this. Call it last, since the files of a begun recording stay.
  Status record(engine::AssembledOperation& operation, const std::string& folder, Headset& headset,
                const std::vector<nav::ToolGeometry>& tools, EventLog& log);
  /// Ends the recording, which `finish` closes, and returns what came to it; absent: none.
  std::optional<engine::RecordedPairs> end_recording();

  /// Writes the reports first, so that no later failure can lose the measurements, then closes the
  /// rest. Returns the first failure.
  Status finish(const engine::OperationResult& result, const std::string& report, bool simulated);
  /// Closes the files of a run that failed for `reason`; returns the reason, with any failures
  /// here.
  [[nodiscard]] std::string close(std::string reason);

 private:
  std::optional<OutFolder> out_;
  KeptOperation kept_;
  std::unique_ptr<replay::RecordingHeadset> recorder_;
  std::optional<RecordingWatch> recording_;
};

}  // namespace orthonav::tools
