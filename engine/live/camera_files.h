#pragma once

#include <string>

#include "base/result.h"
#include "engine/live/calibrated_headset.h"

namespace orthonav::engine {

/// Stereo cameras from a file of `calibrate stereo` or of another calibrator: Kalibr's camchain
/// (pinhole with radtan or equidistant), OpenCV's FileStorage (M1 D1 M2 D2 R T with image_width and
/// image_height; 4, 5, 8 or 12 coefficients, or 4 with `distortion_model: fisheye`), ROS's
/// camera_info of both cameras. Two files are named as one text, LEFT,RIGHT. Each lens becomes a
/// look-up table; a translation must be in metres. Refuses, naming file and field, everything else.
Result<CalibrationFile> load_cameras(const std::string& path);

}  // namespace orthonav::engine
