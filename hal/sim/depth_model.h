#pragma once

#include <optional>

#include "hal/api/camera_model.h"
#include "hal/api/depth_camera.h"

namespace orthonav::sim {

/// A depth camera as it is built.
struct DepthModel {
  DepthStream stream = DepthStream::kAhat;
  BrownConrady lens;
  Transform<DepthSensor, Rig> sensor_from_rig;
  double rate_hz = 45.0;
  /// Where the phase wraps: what is that much farther measures the same. 0: it does not.
  double wraps_at_m = 0.0;
  double farthest_m = 1.0;  ///< beyond it nothing comes back
};

/// HoloLens 2's, in round numbers: 512x512 at 45 Hz, wraps at 1.055 m; 320x288 at 5 Hz. Either
/// looks down from between the front cameras. Nothing about them is centred or square, so that no
/// convention can be mistaken for another.
[[nodiscard]] DepthModel hololens2_ahat();
[[nodiscard]] DepthModel hololens2_long_throw();

/// What the device says of it: the ray of each pixel's centre, none outside the lens's circle.
[[nodiscard]] DepthCalibration calibration_of(const DepthModel& model);

/// What a time-of-flight camera gets wrong; docs/recordings.md says where the figures are from.
struct DepthErrors {
  /// Scale of each material's bias, which grows with 1/cos of the angle of incidence: 1 as
  /// documented, 0 none.
  double bias = 1.0;
  double sd_bright_m = 0.001;  ///< of the noise where much light comes back
  double sd_dim_m = 0.003;     ///< and where hardly any does
  double flying = 0.5;         ///< of the pixels on an edge, how many lie between its two sides
  double metal_lost = 0.4;     ///< of the pixels on metal, how many measure nothing
  [[nodiscard]] static DepthErrors none() { return {0.0, 0.0, 0.0, 0.0, 0.0}; }
};

}  // namespace orthonav::sim
