#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>

#include "nav/guidance/screw_clearance.h"

namespace orthonav::engine {

/// How reliable a study's clearances are: bounds and grades compared with the truth, screw by
/// screw.
struct ClearanceQuality {
  /// The number of screws with a known bound and truth, and for how many the truth lies above the
  /// bound.
  struct Bound {
    int screws = 0;
    int held = 0;
    [[nodiscard]] double fraction() const {
      return screws > 0 ? static_cast<double>(held) / screws : 0.0;
    }
  };
  Bound planned;  ///< of the plan and the registration
  Bound tracked;  ///< of the tool at depth, the registration and the tracking
  using Counts = std::array<int, nav::kPedicleGrades>;
  /// [likeliest grade as tracked][true grade].
  std::array<Counts, nav::kPedicleGrades> grades{};
};
/// Adds a run's report.
void add_run(const nlohmann::ordered_json& run, ClearanceQuality& sum);
/// In the form of the study's JSON.
[[nodiscard]] nlohmann::ordered_json clearance_json(const ClearanceQuality& quality);

}  // namespace orthonav::engine
