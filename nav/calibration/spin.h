#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "nav/statistics/verdict.h"

namespace orthonav::nav {

/// The axis of a tool that was turned about it, with its shaft in a bearing or its tip in a hollow.
struct SpinCalibration {
  Direction<Marker> axis_in_marker;  ///< unit, on the side of the axis that was given
  double off_rad = 0.0;              ///< from that one
  /// RMS of the angle between each inlier's axis and the common one.
  double wobble_rad = 0.0;
  /// How well the amount of turning determines the axis: the square root of 1 - s², with s the
  /// second singular value of the mean rotation; 0 for no turning, 1 for full turns.
  double spread = 0.0;
  /// SD of the axis as an angle: the larger of `leave_out_rad` and the SD predicted from wobble and
  /// spread.
  double axis_sigma_rad = 0.0;
  double leave_out_rad = 0.0;  ///< by leaving out each tenth of the inliers in turn
  /// From the line about which the tool turned to the given tip, in the marker's frame.
  Vec3 tip_beside_m;
  std::size_t poses = 0;
  std::size_t inliers = 0;
  Judgement judgement;  ///< pass or note; what fails is refused
};

/// The direction a with R·a = d in all poses: the right singular vector of the mean rotation with
/// the largest singular value, which is the least-squares solution. Only inliers count, found by a
/// search with random samples of two poses (truncated squares, Torr & Zisserman 2000). Poses must
/// be in the order of time; `tip` and `axis` are those given for the tool. The same poses
/// give the same bits. Refuses too few poses, numbers that are not finite, too
/// little turning, too few inliers, too large a wobble or uncertainty, each with value and limit.
Result<SpinCalibration> spin_calibration(std::span<const Transform<World, Marker>> poses,
                                         Point<Marker> tip, Direction<Marker> axis);

}  // namespace orthonav::nav
