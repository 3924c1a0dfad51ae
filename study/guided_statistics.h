#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace orthonav::engine {

/// Over a study's runs: the guide's display error when wires pierced the bone; screws guided more
/// than `kSilent_mm` off, across the plan, without a warning (`warned` in report.json) and without
/// offsets shown as unsure; and breaches of the cortex without a warning.
struct GuidedQuality {
  static constexpr double kSilent_mm = 2.0;

  std::vector<double> across_mm;
  std::vector<double> tip_mm;
  std::vector<double> angle_deg;
  std::vector<double> across_sds;  ///< of those shown with SDs
  int silent = 0;
  int unwarned = 0;  ///< as far off and without a warning, regardless of how the offsets were shown
  int unsure = 0;    ///< shown with an offset that is not sure
  int executed = 0;
  int breaches = 0;
  int unwarned_breaches = 0;
};
void add_run(const nlohmann::ordered_json& run, GuidedQuality& sum);
/// In the form of the study's JSON: each count with the upper limit of its fraction (95 %, Clopper
/// and Pearson 1934). Null if no screw has these figures.
[[nodiscard]] nlohmann::ordered_json guided_json(const GuidedQuality& quality);

}  // namespace orthonav::engine
