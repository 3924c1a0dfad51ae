#include "hal/sim/error_model.h"

#include <array>
#include <cmath>
#include <sstream>

namespace orthonav::sim {
namespace {

struct Range {
  const char* name;
  double Magnitudes::*value;
  double low;
  double high;
};

// The upper ends are far beyond any real room; past them the scene leaves the cameras' view, or the
// surgeon can't finish.
constexpr std::array<Range, 35> kRanges = {{
    {"blur_sigma_px", &Magnitudes::blur_sigma_px, 0.0, 5.0},
    {"exposure_s", &Magnitudes::exposure_s, 0.0, 0.030},
    {"vignetting", &Magnitudes::vignetting, 0.0, 0.9},
    {"shot_noise", &Magnitudes::shot_noise, 0.0, 10.0},
    {"read_noise_grey", &Magnitudes::read_noise_grey, 0.0, 50.0},
    {"calibration_focal_ratio", &Magnitudes::calibration_focal_ratio, 0.0, 0.05},
    {"calibration_centre_px", &Magnitudes::calibration_centre_px, 0.0, 20.0},
    {"calibration_rotation_rad", &Magnitudes::calibration_rotation_rad, 0.0, 0.05},
    {"calibration_baseline_m", &Magnitudes::calibration_baseline_m, 0.0, 0.01},
    {"head_sway_m", &Magnitudes::head_sway_m, 0.0, 0.1},
    {"head_sway_rad", &Magnitudes::head_sway_rad, 0.0, 0.2},
    {"head_pose_noise_m", &Magnitudes::head_pose_noise_m, 0.0, 0.02},
    {"head_pose_noise_rad", &Magnitudes::head_pose_noise_rad, 0.0, 0.02},
    {"map_drift_m_per_sqrt_s", &Magnitudes::map_drift_m_per_sqrt_s, 0.0, 0.01},
    {"map_drift_rad_per_sqrt_s", &Magnitudes::map_drift_rad_per_sqrt_s, 0.0, 0.01},
    {"tip_calibration_m", &Magnitudes::tip_calibration_m, 0.0, 0.02},
    {"axis_calibration_rad", &Magnitudes::axis_calibration_rad, 0.0, 0.2},
    {"tremor_m", &Magnitudes::tremor_m, 0.0, 0.01},
    {"tremor_rad", &Magnitudes::tremor_rad, 0.0, 0.1},
    {"stroke_lift_m", &Magnitudes::stroke_lift_m, 0.0, 0.02},
    {"touch_lift_m", &Magnitudes::touch_lift_m, 0.0, 0.02},
    {"stroke_pace_sd", &Magnitudes::stroke_pace_sd, 0.0, 1.0},
    {"bad_stroke_probability", &Magnitudes::bad_stroke_probability, 0.0, 0.9},
    {"bad_stroke_lift_m", &Magnitudes::bad_stroke_lift_m, 0.0, 0.05},
    {"voice_doubt", &Magnitudes::voice_doubt, 0.0, 1.0},
    {"voice_doubt_sd", &Magnitudes::voice_doubt_sd, 0.0, 1.0},
    {"entry_pick_m", &Magnitudes::entry_pick_m, 0.0, 0.02},
    {"first_guess_rad", &Magnitudes::first_guess_rad, 0.0, 0.5},
    {"head_pick_m", &Magnitudes::head_pick_m, 0.0, 0.02},
    {"angle_reading_rad", &Magnitudes::angle_reading_rad, 0.0, 0.5},
    {"overlay_perception_m", &Magnitudes::overlay_perception_m, 0.0, 0.03},
    {"overlay_comparison_m", &Magnitudes::overlay_comparison_m, 0.0, 0.03},
    {"wire_skiving_m", &Magnitudes::wire_skiving_m, 0.0, 0.02},
    {"wire_bending_rad", &Magnitudes::wire_bending_rad, 0.0, 0.5},
    {"pace_sd", &Magnitudes::pace_sd, 0.0, 1.0},
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

Magnitudes Magnitudes::perfect() {
  Magnitudes none;
  for (const Range& range : kRanges) none.*range.value = 0.0;
  return none;
}

Magnitudes Magnitudes::navigation_alone() {
  Magnitudes alone;
  for (double Magnitudes::*later :
       {&Magnitudes::entry_pick_m, &Magnitudes::head_pick_m, &Magnitudes::angle_reading_rad,
        &Magnitudes::overlay_perception_m, &Magnitudes::overlay_comparison_m,
        &Magnitudes::wire_skiving_m, &Magnitudes::wire_bending_rad})
    alone.*later = 0.0;
  return alone;
}

std::vector<std::string> Magnitudes::check() const {
  std::vector<std::string> problems;
  // Negated, so that NaN fails too.
  for (const auto& [name, value, low, high] : kRanges)
    if (!(this->*value >= low && this->*value <= high))
      problems.push_back(complaint(name, this->*value, low, high));
  if (!(pace >= kSlowestPace && pace <= kFastestPace))
    problems.push_back(complaint("pace", pace, kSlowestPace, kFastestPace));
  return problems;
}

}  // namespace orthonav::sim
