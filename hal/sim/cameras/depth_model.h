#pragma once

#include <optional>

#include "hal/api/camera_model.h"
#include "hal/api/depth_camera.h"

namespace orthonav::sim {

/// The construction of a depth camera.
struct DepthModel {
  DepthStream stream = DepthStream::kAhat;
  BrownConrady lens;
  Transform<DepthSensor, Rig> sensor_from_rig;
  double rate_hz = 45.0;
  /// Distance after which the phase wraps: an object farther by this much measures the same. 0: it
  /// does not wrap.
  double wraps_at_m = 0.0;
  double farthest_m = 1.0;  ///< no light returns from beyond it
};

/// HoloLens 2's, in round numbers: 512x512 at 45 Hz, wraps at 1.055 m; 320x288 at 5 Hz. Both look
/// down from between the front cameras. Nothing about them is centred or square, so that mistaken
/// conventions show up.
[[nodiscard]] DepthModel hololens2_ahat();
[[nodiscard]] DepthModel hololens2_long_throw();

/// The calibration that the device reports: the ray of each pixel's centre, none outside the lens's
/// circle.
[[nodiscard]] DepthCalibration calibration_of(const DepthModel& model);

/// Errors of a time-of-flight camera; docs/recordings.md gives the sources of the figures.
struct DepthErrors {
  /// Scale of each material's bias, which grows with 1/cos of the angle of incidence: 1 as
  /// documented, 0 none.
  double bias = 1.0;
  double sd_bright_m = 0.001;  ///< of the noise where much light returns
  double sd_dim_m = 0.003;     ///< of the noise where hardly any returns
  double flying = 0.5;  ///< fraction of the pixels on an edge that measure between its two sides
  double metal_lost = 0.4;  ///< fraction of the pixels on metal that measure nothing
  [[nodiscard]] static DepthErrors none() { return {0.0, 0.0, 0.0, 0.0, 0.0}; }
};

}  // namespace orthonav::sim
