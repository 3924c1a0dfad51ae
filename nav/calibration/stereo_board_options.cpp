#include "base/findings.h"
#include "nav/calibration/stereo_board.h"

namespace orthonav::nav {

std::vector<std::string> StereoBoardOptions::check() const {
  std::vector<std::string> problems;
  if (min_views < 3) {
    problems.push_back("min_views " + std::to_string(min_views) + ", must be at least 3");
  }
  if (!(outlier_factor > 1.0)) {
    problems.push_back("outlier_factor " + std::to_string(outlier_factor) + ", must be above 1");
  }
  if (!(max_outlier_fraction >= 0.0 && max_outlier_fraction < 1.0)) {
    problems.push_back("max_outlier_fraction " + std::to_string(max_outlier_fraction) +
                       ", must be at least 0 and below 1");
  }
  must_be_positive({{"max_rms_px", max_rms_px},
                    {"max_focal_sigma_fraction", max_focal_sigma_fraction},
                    {"note_rms_px", note_rms_px},
                    {"note_focal_sigma_fraction", note_focal_sigma_fraction},
                    {"note_baseline_sigma_fraction", note_baseline_sigma_fraction},
                    {"note_covered_fraction", note_covered_fraction}},
                   problems);
  return problems;
}

}  // namespace orthonav::nav
