#include "tools/preview/error_sources.h"

#include <array>
#include <numbers>

namespace orthonav::preview {
namespace {

using sim::ErrorModel;

constexpr double kMm = 1e3;
constexpr double kDeg = 180.0 / std::numbers::pi;

constexpr auto kSources = std::to_array<ErrorSource>({
    {"cameras", "blur", "px", &ErrorModel::blur_sigma_px, 1.0, 3.0},
    {"cameras", "exposure", "ms", &ErrorModel::exposure_s, 1e3, 16.0},
    {"cameras", "vignetting", "%", &ErrorModel::vignetting, 100.0, 80.0},
    {"cameras", "shot noise", "grey²/grey", &ErrorModel::shot_noise, 1.0, 1.0},
    {"cameras", "read noise", "grey", &ErrorModel::read_noise_grey, 1.0, 10.0},
    {"calibration", "focal length", "%", &ErrorModel::calibration_focal_ratio, 100.0, 1.0},
    {"calibration", "centre", "px", &ErrorModel::calibration_centre_px, 1.0, 2.0},
    {"calibration", "rotation", "°", &ErrorModel::calibration_rotation_rad, kDeg, 0.3},
    {"calibration", "baseline", "mm", &ErrorModel::calibration_baseline_m, kMm, 2.0},
    {"calibration", "tip", "mm", &ErrorModel::tip_calibration_m, kMm, 3.0},
    {"calibration", "axis", "°", &ErrorModel::axis_calibration_rad, kDeg, 2.0},
    {"head and map", "sway", "mm", &ErrorModel::head_sway_m, kMm, 50.0},
    {"head and map", "sway, turning", "°", &ErrorModel::head_sway_rad, kDeg, 6.0},
    {"head and map", "pose noise", "mm", &ErrorModel::head_pose_noise_m, kMm, 5.0},
    {"head and map", "pose noise, turning", "°", &ErrorModel::head_pose_noise_rad, kDeg, 0.3},
    {"head and map", "map drift", "mm/√s", &ErrorModel::map_drift_m_per_sqrt_s, kMm, 2.0},
    {"head and map", "map drift, turning", "°/√s", &ErrorModel::map_drift_rad_per_sqrt_s, kDeg,
     0.1},
    {"hand", "tremor", "mm", &ErrorModel::tremor_m, kMm, 3.0},
    {"hand", "tremor, turning", "°", &ErrorModel::tremor_rad, kDeg, 2.0},
    {"hand", "lift of strokes", "mm", &ErrorModel::stroke_lift_m, kMm, 6.0},
    {"hand", "lift of touches", "mm", &ErrorModel::touch_lift_m, kMm, 3.0},
    {"hand", "tip in a landmark", "mm", &ErrorModel::landmark_seating_m, kMm, 2.0},
    {"hand", "bad strokes", "%", &ErrorModel::bad_stroke_probability, 100.0, 90.0},
    {"hand", "picking an entry", "mm", &ErrorModel::entry_pick_m, kMm, 5.0},
    {"hand", "picking a head", "mm", &ErrorModel::head_pick_m, kMm, 5.0},
    {"hand", "first guess of the axis", "°", &ErrorModel::first_guess_rad, kDeg, 25.0},
    {"eye", "reading the angle", "°", &ErrorModel::angle_reading_rad, kDeg, 3.0},
    {"eye", "place of a hologram", "mm", &ErrorModel::overlay_perception_m, kMm, 8.0},
    {"eye", "model against bone", "mm", &ErrorModel::overlay_comparison_m, kMm, 8.0},
    {"wire", "skiving", "mm", &ErrorModel::wire_skiving_m, kMm, 6.0},
    {"wire", "bending", "°", &ErrorModel::wire_bending_rad, kDeg, 6.0},
    {"surgeon", "pace", "times", &ErrorModel::pace, 1.0, 4.0, 0.5},
    {"surgeon", "doubt in what was said", "", &ErrorModel::voice_doubt, 1.0, 0.9},
});

}  // namespace

std::span<const ErrorSource> error_sources() { return kSources; }

}  // namespace orthonav::preview
