#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/report/paper_table.h"
#include "study/clearance_statistics.h"
#include "study/guided_statistics.h"
#include "study/study_statistics.h"

namespace orthonav::engine {

/// A study's totals over all its runs, added up run by run: it keeps a few numbers of each run, not
/// its report.
class StudyTotals {
 public:
  void add(const nlohmann::ordered_json& run);
  /// The JSON of a study (docs/file-formats.md) with `runs` in its place. `planned`: the number of
  /// planned runs; larger than the actual number if it was stopped.
  [[nodiscard]] nlohmann::ordered_json study(const std::string& method,
                                             const nlohmann::ordered_json& runs,
                                             const nlohmann::ordered_json& failed,
                                             std::size_t planned) const;

 private:
  std::size_t runs_ = 0;
  int completed_ = 0;
  std::array<std::vector<double>, kPaperTable.size()> rows_;
  RegistrationCounts registrations_;
  ClearanceQuality clearance_;
  GuidedQuality guided_;
};

}  // namespace orthonav::engine
