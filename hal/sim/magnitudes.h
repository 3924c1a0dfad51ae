#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orthonav::sim {

/// Every imperfection of the simulated operating room, with its source. `perfect()` has all of them
/// at zero. Defaults are the documented values; docs/accuracy.md discusses them.
struct Magnitudes {
  // The camera: HoloLens 2 front cameras.
  double blur_sigma_px = 0.7;    ///< point spread of lens and pixel, besides the pixel's square
  double exposure_s = 0.004;     ///< motion blur lasts so long
  double vignetting = 0.3;       ///< loss of light in the corner of the image
  double shot_noise = 0.1;       ///< SD² of a grey value per grey value (photon statistics)
  double read_noise_grey = 1.0;  ///< SD of a grey value
  // The calibration that the device reports, against the true one.
  double calibration_focal_ratio = 0.001;    ///< SD, each camera
  double calibration_centre_px = 0.3;        ///< SD, each camera and axis
  double calibration_rotation_rad = 0.0008;  ///< SD an axis, right against left camera
  double calibration_baseline_m = 0.0002;    ///< SD an axis
  // The head and the map.
  double head_sway_m = 0.012;              ///< SD an axis of the head's position
  double head_sway_rad = 0.03;             ///< SD an axis of its rotation
  double head_pose_noise_m = 0.0003;       ///< SD an axis, white, of the reported head pose
  double head_pose_noise_rad = 0.0003;     ///< SD an axis
  double map_drift_m_per_sqrt_s = 0.0001;  ///< random walk of World against the room, an axis
  double map_drift_rad_per_sqrt_s = 0.00005;
  // The tools as the planning file describes them, against how they are.
  double tip_calibration_m = 0.0005;    ///< SD an axis of the tip
  double axis_calibration_rad = 0.003;  ///< SD an axis of the guide's axis
  // The hand and the surgeon.
  double tremor_m = 0.0003;              ///< SD an axis of the tip, 8-12 Hz
  double tremor_rad = 0.003;             ///< SD an axis
  double stroke_lift_m = 0.0010;         ///< SD of the tip above the bone (soft tissue, lift-off)
  double bad_stroke_probability = 0.1;   ///< a stroke that slips off and is deleted
  double entry_pick_m = 0.0010;          ///< SD an axis of putting the tip on the shown entry
  double angle_reading_rad = 0.005;      ///< accepted when the reading is within about this
  double overlay_perception_m = 0.0020;  ///< SD of where a hologram is perceived (depth of focus)
  double wire_skiving_m = 0.0015;  ///< SD an axis of the wire's slip on the cortex at piercing
  double wire_bending_rad = 0.03;  ///< SD an axis of the wire's bending while driven
  double pace = 1.0;               ///< median of the surgeon's pace; 1 is the paper's
  double pace_sd = 0.2;            ///< relative SD of the pace over surgeons

  static Magnitudes perfect();
  /// Everything wrong with the numbers, a line each: name, value, limit. Empty: fine.
  [[nodiscard]] std::vector<std::string> check() const;
};

}  // namespace orthonav::sim
