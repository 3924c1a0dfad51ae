#include "tools/preview/error_sources.h"

#include <array>
#include <numbers>

namespace orthonav::preview {
namespace {

using sim::Magnitudes;

constexpr double kMm = 1e3;
constexpr double kDeg = 180.0 / std::numbers::pi;

constexpr auto kSources = std::to_array<ErrorSource>({
    {"cameras", "blur", "px", &Magnitudes::blur_sigma_px, 1.0, 3.0},
    {"cameras", "exposure", "ms", &Magnitudes::exposure_s, 1e3, 16.0},
    {"cameras", "vignetting", "%", &Magnitudes::vignetting, 100.0, 80.0},
    {"cameras", "shot noise", "grey²/grey", &Magnitudes::shot_noise, 1.0, 1.0},
    {"cameras", "read noise", "grey", &Magnitudes::read_noise_grey, 1.0, 10.0},
    {"calibration", "focal length", "%", &Magnitudes::calibration_focal_ratio, 100.0, 1.0},
    {"calibration", "centre", "px", &Magnitudes::calibration_centre_px, 1.0, 2.0},
    {"calibration", "rotation", "deg", &Magnitudes::calibration_rotation_rad, kDeg, 0.3},
    {"calibration", "baseline", "mm", &Magnitudes::calibration_baseline_m, kMm, 2.0},
    {"calibration", "tip", "mm", &Magnitudes::tip_calibration_m, kMm, 3.0},
    {"calibration", "axis", "deg", &Magnitudes::axis_calibration_rad, kDeg, 2.0},
    {"head and map", "sway", "mm", &Magnitudes::head_sway_m, kMm, 50.0},
    {"head and map", "sway, turning", "deg", &Magnitudes::head_sway_rad, kDeg, 6.0},
    {"head and map", "pose noise", "mm", &Magnitudes::head_pose_noise_m, kMm, 5.0},
    {"head and map", "pose noise, turning", "deg", &Magnitudes::head_pose_noise_rad, kDeg, 0.3},
    {"head and map", "map drift", "mm/√s", &Magnitudes::map_drift_m_per_sqrt_s, kMm, 2.0},
    {"head and map", "map drift, turning", "deg/√s", &Magnitudes::map_drift_rad_per_sqrt_s, kDeg,
     0.1},
    {"hand", "tremor", "mm", &Magnitudes::tremor_m, kMm, 3.0},
    {"hand", "tremor, turning", "deg", &Magnitudes::tremor_rad, kDeg, 2.0},
    {"hand", "lift of strokes", "mm", &Magnitudes::stroke_lift_m, kMm, 6.0},
    {"hand", "lift of touches", "mm", &Magnitudes::touch_lift_m, kMm, 3.0},
    {"hand", "bad strokes", "%", &Magnitudes::bad_stroke_probability, 100.0, 90.0},
    {"hand", "picking an entry", "mm", &Magnitudes::entry_pick_m, kMm, 5.0},
    {"hand", "picking a head", "mm", &Magnitudes::head_pick_m, kMm, 5.0},
    {"hand", "first guess of the axis", "deg", &Magnitudes::first_guess_rad, kDeg, 25.0},
    {"eye", "reading the angle", "deg", &Magnitudes::angle_reading_rad, kDeg, 3.0},
    {"eye", "place of a hologram", "mm", &Magnitudes::overlay_perception_m, kMm, 8.0},
    {"eye", "model against bone", "mm", &Magnitudes::overlay_comparison_m, kMm, 8.0},
    {"wire", "skiving", "mm", &Magnitudes::wire_skiving_m, kMm, 6.0},
    {"wire", "bending", "deg", &Magnitudes::wire_bending_rad, kDeg, 6.0},
    {"surgeon", "pace", "times", &Magnitudes::pace, 1.0, 4.0, 0.5},
    {"surgeon", "doubt in what was said", "", &Magnitudes::voice_doubt, 1.0, 0.9},
});

}  // namespace

std::span<const ErrorSource> error_sources() { return kSources; }

}  // namespace orthonav::preview
