#pragma once

#include <span>
#include <string>
#include <vector>

#include "nav/calibration/body_sightings.h"
#include "nav/statistics/verdict.h"

namespace orthonav::nav {

/// A tag of a flat board and where it is printed.
struct BoardTag {
  MarkerDefinition definition;
  Transform<Marker, Tag> board_from_tag;  ///< the board's frame stands in for a marker's
};

/// The cameras' relative pose in a recording, compared with what the device reports.
struct StereoRecording {
  Transform<RightCamera, Rig> right_from_rig;
  Transform<RightCamera, LeftCamera> right_from_left;
  /// From the device's right camera to the measured one, in its own frame.
  Vec3 rotation_rad;
  Vec3 translation_m;
  double rotation_sigma_rad = 0.0;  ///< 3-D, the larger of predicted and jackknife
  double translation_sigma_m = 0.0;
  /// RMS distance over the corners by which rotation and translation move them across the epipolar
  /// lines, and its SD from a jackknife over tenths of the recording.
  double off_px = 0.0;
  double off_sigma_px = 0.0;
  bool is_off = false;  ///< significantly
  double epipolar_before_px =
      0.0;  ///< RMS distance from the epipolar lines, as the device has them
  double epipolar_after_px = 0.0;
  double rms_px = 0.0;  ///< of the corners, 2-D
  double covered_fraction = 0.0;
  double size_ratio = 0.0;  ///< median triangulated edge, relative to the size given
  std::size_t pairs = 0;
  Judgement judgement;
};

/// The right camera's pose from a board of tags seen in many pairs: non-linear least squares over
/// all corners (`adjust`), which finds the board's pose in each pair as well; the lenses stay as
/// the device reports them. Pairs must be in the order of time. Refuses too few pairs,
/// sizes that the images contradict, and corners that do not determine the result.
Result<StereoRecording> calibrate_stereo(const StereoCalibration& calibration,
                                         std::span<const BoardTag> board,
                                         std::span<const PairSightings> pairs);

}  // namespace orthonav::nav
