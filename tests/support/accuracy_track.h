#pragma once

#include <vector>

#include "base/random.h"
#include "nav/tracking/tool_tracker.h"

namespace orthonav::test {

/// A pointer whose tip is known at every moment, as a perfect or a noisy tracker sees it.
struct AccuracyTrackOptions {
  Vec3 tip_m{0.004, -0.15, 0.002};  ///< according to the tool file
  double rate_hz = 30.0;
  double position_noise_m = 0.00005;  ///< SD an axis
  double rotation_noise_rad = 0.0002;
  Vec3 tip_error_m{};  ///< true tip minus the tool file's, in the marker's axes
  double still_s = 3.0;
  double turning_s = 8.0;
  double tilt_rad = 0.45;  ///< half angle of the cone
  double touch_s = 0.8;
  Vec3 slip_while_still_m{};  ///< the dimple moves by this in the middle of the part
  Vec3 slip_while_turning_m{};
  double board_scale = 1.0;
  bool lay_aside = false;  ///< the pointer rests somewhere else before the board
  std::uint64_t seed = 1;
};

/// With the tip of the default options, 150 mm below the tag.
nav::ToolGeometry accuracy_pointer();
/// Nine points, 60 mm and 50 mm apart.
std::vector<Vec3> accuracy_board();
/// The pointer comes from the air, rests in the dimple, turns there, and touches the points in
/// order.
std::vector<nav::TrackedPose> accuracy_track(const AccuracyTrackOptions& options,
                                             const std::vector<Vec3>& touched);

}  // namespace orthonav::test
