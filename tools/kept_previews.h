#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "hal/sim/sim_headset.h"
#include "tools/kept_operation.h"
#include "tools/out_folder.h"

namespace orthonav::tools {

/// `--keep` and `--resume`, of the preview.
struct KeepArguments {
  std::string keep;    ///< folder; empty: nothing is kept
  std::string resume;  ///< folder with the operation to go on with; empty: a new one

  void add_to(CLI::App& command);
};

/// Keeps the operations of a preview, which can be started again and again, in a folder: the last
/// one under the name that `--resume` looks for.
class KeptPreviews {
 public:
  /// Looks for the operation to be resumed, or makes the folder.
  Status open(const KeepArguments& arguments);
  /// Goes on with that operation, the first time, or begins another.
  Status begin(engine::AssembledOperation& operation, const std::string& case_name,
               const std::string& method, const sim::SimHeadset* room);
  /// After `begin`, once it has ended; says on standard error what was not saved.
  void ended(const Result<engine::LoopReport>& report);

 private:
  std::optional<OutFolder> folder_;  ///< none: nothing is kept
  std::optional<KeptOperation> kept_;
};

}  // namespace orthonav::tools
