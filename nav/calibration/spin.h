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

struct SpinOptions {
  std::size_t min_poses = 20;
  /// Least `spread`: turning evenly over 60° has 0.3, over 90° 0.44, over 120° 0.56.
  double min_spread = 0.3;
  /// A pose whose axis deviates by more from the common one is not an inlier; if the poses scatter
  /// less, the limit shrinks with them.
  double inlier_rad = 0.035;
  double min_inlier_fraction = 0.6;
  /// The axis about which the tool turned must lie within this angle of the tool's given axis;
  /// otherwise it was a different movement.
  double max_off_rad = 0.26;
  double max_wobble_rad = 0.02;
  double max_axis_sigma_rad = 0.0087;  ///< 0.5°
  /// Limits beyond which a result gets a note.
  double note_spread = 0.44;
  double note_axis_sigma_rad = 0.0035;  ///< 0.2°
  double note_tip_beside_m = 0.001;
  int rounds = 500;  ///< random samples tried
  std::uint64_t seed = 1;

  /// Every problem at once.
  [[nodiscard]] std::vector<std::string> check() const;
};

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
/// be in the order of time; `tip` and `axis` are those given for the tool. The same poses and
/// options give the same bits. Refuses bad options, too few poses, numbers that are not finite, too
/// little turning, too few inliers, too large a wobble or uncertainty, each with value and limit.
Result<SpinCalibration> spin_calibration(std::span<const Transform<World, Marker>> poses,
                                         Point<Marker> tip, Direction<Marker> axis,
                                         const SpinOptions& options = {});

}  // namespace orthonav::nav
