#include "hal/sim/error_model.h"

#include <array>
#include <cmath>
#include <sstream>

namespace orthonav::sim {
namespace {

struct Range {
  const char* name;
  double ErrorModel::*value;
  double low;
  double high;
};

// The upper ends are far beyond any real room; past them the scene leaves the cameras' view, or the
// surgeon can't finish.
constexpr std::array<Range, 35> kRanges = {{
    {"blur_sigma_px", &ErrorModel::blur_sigma_px, 0.0, 5.0},
    {"exposure_s", &ErrorModel::exposure_s, 0.0, 0.030},
    {"vignetting", &ErrorModel::vignetting, 0.0, 0.9},
    {"shot_noise", &ErrorModel::shot_noise, 0.0, 10.0},
    {"read_noise_grey", &ErrorModel::read_noise_grey, 0.0, 50.0},
    {"calibration_focal_ratio", &ErrorModel::calibration_focal_ratio, 0.0, 0.05},
    {"calibration_centre_px", &ErrorModel::calibration_centre_px, 0.0, 20.0},
    {"calibration_rotation_rad", &ErrorModel::calibration_rotation_rad, 0.0, 0.05},
    {"calibration_baseline_m", &ErrorModel::calibration_baseline_m, 0.0, 0.01},
    {"head_sway_m", &ErrorModel::head_sway_m, 0.0, 0.1},
    {"head_sway_rad", &ErrorModel::head_sway_rad, 0.0, 0.2},
    {"head_pose_noise_m", &ErrorModel::head_pose_noise_m, 0.0, 0.02},
    {"head_pose_noise_rad", &ErrorModel::head_pose_noise_rad, 0.0, 0.02},
    {"map_drift_m_per_sqrt_s", &ErrorModel::map_drift_m_per_sqrt_s, 0.0, 0.01},
    {"map_drift_rad_per_sqrt_s", &ErrorModel::map_drift_rad_per_sqrt_s, 0.0, 0.01},
    {"tip_calibration_m", &ErrorModel::tip_calibration_m, 0.0, 0.02},
    {"axis_calibration_rad", &ErrorModel::axis_calibration_rad, 0.0, 0.2},
    {"tremor_m", &ErrorModel::tremor_m, 0.0, 0.01},
    {"tremor_rad", &ErrorModel::tremor_rad, 0.0, 0.1},
    {"stroke_lift_m", &ErrorModel::stroke_lift_m, 0.0, 0.02},
    {"touch_lift_m", &ErrorModel::touch_lift_m, 0.0, 0.02},
    {"stroke_pace_sd", &ErrorModel::stroke_pace_sd, 0.0, 1.0},
    {"bad_stroke_probability", &ErrorModel::bad_stroke_probability, 0.0, 0.9},
    {"bad_stroke_lift_m", &ErrorModel::bad_stroke_lift_m, 0.0, 0.05},
    {"voice_doubt", &ErrorModel::voice_doubt, 0.0, 1.0},
    {"voice_doubt_sd", &ErrorModel::voice_doubt_sd, 0.0, 1.0},
    {"entry_pick_m", &ErrorModel::entry_pick_m, 0.0, 0.02},
    {"first_guess_rad", &ErrorModel::first_guess_rad, 0.0, 0.5},
    {"head_pick_m", &ErrorModel::head_pick_m, 0.0, 0.02},
    {"angle_reading_rad", &ErrorModel::angle_reading_rad, 0.0, 0.5},
    {"overlay_perception_m", &ErrorModel::overlay_perception_m, 0.0, 0.03},
    {"overlay_comparison_m", &ErrorModel::overlay_comparison_m, 0.0, 0.03},
    {"wire_skiving_m", &ErrorModel::wire_skiving_m, 0.0, 0.02},
    {"wire_bending_rad", &ErrorModel::wire_bending_rad, 0.0, 0.5},
    {"pace_sd", &ErrorModel::pace_sd, 0.0, 1.0},
}};
constexpr double kSlowestPace = 0.1;
constexpr double kFastestPace = 10.0;

std::string complaint(const char* name, double value, double low, double high) {
  std::ostringstream line;
  line << "magnitude " << name << " is " << value << ", must lie in [" << low << ", " << high
       << "]";
  return line.str();
}

}  // namespace

ErrorModel ErrorModel::perfect() {
  ErrorModel none;
  for (const Range& range : kRanges) {
    none.*range.value = 0.0;
  }
  return none;
}

ErrorModel ErrorModel::navigation_alone() {
  ErrorModel alone;
  for (double ErrorModel::*later :
       {&ErrorModel::entry_pick_m, &ErrorModel::head_pick_m, &ErrorModel::angle_reading_rad,
        &ErrorModel::overlay_perception_m, &ErrorModel::overlay_comparison_m,
        &ErrorModel::wire_skiving_m, &ErrorModel::wire_bending_rad}) {
    alone.*later = 0.0;
  }
  return alone;
}

std::vector<std::string> ErrorModel::check() const {
  std::vector<std::string> problems;
  // Negated, so that NaN fails too.
  for (const auto& [name, value, low, high] : kRanges) {
    if (!(this->*value >= low && this->*value <= high)) {
      problems.push_back(complaint(name, this->*value, low, high));
    }
  }
  if (!(pace >= kSlowestPace && pace <= kFastestPace)) {
    problems.push_back(complaint("pace", pace, kSlowestPace, kFastestPace));
  }
  return problems;
}

}  // namespace orthonav::sim
