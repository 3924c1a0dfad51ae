#pragma once

#include <cstdint>

#include "base/vec.h"
#include "hal/api/devices.h"

namespace orthonav::nav {

/// How the cameras appear to differ from their reported calibration.
struct StereoAlignment {
  Vec3 rotation_rad{};  ///< of the right camera, in its frame, relative to the reported calibration
  Vec3 sd_rad{};
  std::int64_t pairs = 0;
  bool significant = false;
  bool within_bounds = true;
  bool applied = false;  ///< poses take the rotation into account
  /// The right camera's focal length divided by the left one's, and the baseline's length, as
  /// fractions by which they exceed what is reported. Poses do not take them into account.
  double focal_fraction = 0.0;
  double focal_sd = 0.0;
  double baseline_fraction = 0.0;
  double baseline_sd = 0.0;
};

/// Turns the right camera by a rotation vector (rad) in its own frame.
inline void rotate_right_camera(StereoCalibration& calibration, Vec3 rotation_rad) {
  const Transform<RightCamera, RightCamera> correction(rotation_from_vector(rotation_rad), {});
  calibration.right_from_rig = correction * calibration.right_from_rig;
}

/// The size of a tool's tags as the two cameras measure it.
struct TagSize {
  double fraction = 0.0;  ///< by which they are larger than stated
  double sd = 0.0;
  std::int64_t measurements = 0;
  bool notable = false;  ///< more than small errors of the cameras could cause
  /// Certainly a different size than stated: a wrong print or a wrong unit (or misaligned cameras).
  /// Poses are then wrong.
  bool disagrees = false;
  double applied = 0.0;  ///< the part of `fraction` that poses take into account
};

}  // namespace orthonav::nav
