#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/report/operation_result.h"
#include "engine/session/journal.h"
#include "hal/replay/recorder.h"
#include "nav/tracking/tool.h"
#include "tools/kept_operation.h"
#include "tools/out_folder.h"
#include "tools/recording_watch.h"

namespace orthonav::tools {

/// Says on standard error where journals of earlier sessions in the same folder are, if there were.
void tell_of_earlier(const engine::Journal& journal);

/// What `run` leaves behind: journal and reports in one folder, a recording in another, each only
/// where it was asked for.
class RunFiles {
 public:
  /// Makes the folder and opens the journal in it. An operation that is resumed goes on without a
  /// journal where none can be made, and says so.
  Status open_journal(const std::string& folder, const engine::JournalHeader& header);
  /// The operation to be resumed, which is looked for before anything else.
  [[nodiscard]] KeptOperation& kept() { return kept_; }
  /// Begins the log of the operation in that folder, or goes on with the one that was found.
  Status keep(engine::AssembledOperation& operation, const KeptOperation::About& about);
  /// Lets the operation go on through a recorder of `headset`; all, and `log`, must outlive this.
  /// Last of all, since the files of a recording that was begun stay.
  Status record(engine::AssembledOperation& operation, const std::string& folder, Headset& headset,
                const std::vector<nav::ToolGeometry>& tools, EventLog& log);
  /// Null: none.
  [[nodiscard]] engine::Journal* journal() const { return journal_.get(); }

  /// Writes the reports first, so that no later failure can lose the measurements, then closes the
  /// rest. Returns the first failure.
  Status finish(const engine::OperationResult& result, const std::string& report, bool simulated);
  /// Closes what was written before a run failed for `reason`; returns it with what failed here.
  [[nodiscard]] std::string close(std::string reason);

 private:
  std::optional<OutFolder> out_;
  std::unique_ptr<engine::Journal> journal_;
  KeptOperation kept_;
  std::unique_ptr<replay::RecordingHeadset> recorder_;
  std::optional<RecordingWatch> recording_;
};

}  // namespace orthonav::tools
