#pragma once

#include <set>
#include <string>

#include "engine/case/case.h"
#include "engine/case/screw_sizes.h"
#include "tools/orthonav/shared/plan_figures.h"

namespace orthonav::tools {

/// The plans that other programs send for the levels of a case before an operation
/// (docs/igtl.md). One thread.
class ReceivedPlans {
 public:
  ReceivedPlans(engine::Case subject, engine::ScrewSizes sizes)
      : subject_(std::move(subject)), sizes_(std::move(sizes)) {}

  /// The case with its screws as they are now.
  [[nodiscard]] const engine::Case& subject() const { return subject_; }
  [[nodiscard]] const engine::ScrewSizes& sizes() const { return sizes_; }
  /// The levels for which a plan was taken.
  [[nodiscard]] const std::set<std::string>& received() const { return received_; }

  /// Replaces all screws of a level by those of a plan, the text of a plan's file (`parse_plan`).
  /// Refused as a whole, and changing nothing, where it names no level of the case, does not fit
  /// the bone (`screws_on`), or holds a screw that leaves the cortex without saying why it may.
  Result<JudgedLevel> take(const std::string& text);

 private:
  engine::Case subject_;
  engine::ScrewSizes sizes_;
  std::set<std::string> received_;
};

}  // namespace orthonav::tools
