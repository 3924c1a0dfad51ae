#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "hal/sim/sim_headset.h"
#include "study/set_up.h"
#include "tools/orthonav/operation/kept_operation.h"
#include "tools/orthonav/shared/out_folder.h"

namespace orthonav::tools {

/// `--keep` and `--resume`, of the preview.
struct KeepArguments {
  std::string keep;    ///< folder; empty: nothing is kept
  std::string resume;  ///< folder with the operation to resume; empty: a new one

  void add_to(CLI::App& command);
};

/// Keeps the operations of a preview, which can be restarted any number of times, in a folder: the
/// last one under the name that `--resume` looks for.
class KeptPreviews {
 public:
  /// Looks for the operation to be resumed, or makes the folder.
  Status open(const KeepArguments& arguments);
  /// Resumes that operation the first time, or begins another one.
  Status begin(engine::AssembledOperation& operation, const std::string& case_name,
               const engine::SetUp& set_up, const sim::SimHeadset* room);
  /// Where patient references lie in the World of the operation to be resumed.
  [[nodiscard]] std::vector<nav::ReferencePlace> reference_places() const;
  /// Call after the operation has ended; reports on standard error what was not saved.
  void ended(const engine::LoopReport& report);

 private:
  std::optional<OutFolder> folder_;  ///< none: nothing is kept
  std::optional<KeptOperation> kept_;
};

}  // namespace orthonav::tools
