#pragma once

#include <array>
#include <string_view>

namespace orthonav::engine {

/// One row of the published results (Liebmann et al. 2019, Table 1) and where report.json holds the
/// corresponding values.
struct PaperRow {
  std::string_view name;
  std::string_view unit;
  std::string_view key;  ///< of a screw or of a level in report.json
  bool per_screw = false;
  double mean = 0.0;
  double sd = 0.0;
  int decimals = 2;
  bool input = false;  ///< in a simulation: an input of the scripted surgeon, not a result
};

inline constexpr std::array<PaperRow, 5> kPaperTable = {{
    {"Trajectory error", "\u00b0", "angle_error_deg", true, 3.38, 1.73, 2},
    {"Entry point error", "mm", "entry_error_mm", true, 2.77, 1.46, 2},
    {"Registration RMSE", "mm", "rmse_mm", false, 1.62, 0.26, 2},
    {"Digitization time", "s", "digitization_s", false, 125.0, 27.0, 0, true},
    {"Digitized points", "", "points", false, 1983.0, 404.0, 0, true},
}};

}  // namespace orthonav::engine
