#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hal/api/devices.h"
#include "nav/calibration/body_sightings.h"

namespace orthonav::nav {

/// What an adjustment finds: the pose of the right camera, the poses of the tags on the body, and
/// the pose of the body in each pair.
struct BodyState {
  Transform<RightCamera, Rig> right_from_rig;
  std::vector<Transform<Marker, Tag>> marker_from_tag;
  std::vector<Transform<Rig, Marker>> rig_from_marker;
};

/// A rigid body of tags in front of two cameras, pair after pair.
struct BodyProblem {
  StereoCalibration calibration;
  std::vector<double> size_m;  ///< of each tag
  std::vector<PairSightings> pairs;
  bool find_right_camera = false;  ///< false: taken from the calibration
  std::vector<bool> find_tag;      ///< false: its pose stays as in the state
};

/// The residuals after the adjustment, and how exact the results are.
struct BodyFit {
  double rms_px = 0.0;       ///< of the corners that are not outliers, 2-D
  std::size_t corners = 0;   ///< seen, in both images
  std::size_t outliers = 0;  ///< corners that disagree with the others
  /// Predicted covariances of (translation m, rotation rad) of the poses found: the right camera
  /// (in its own frame), then the tags (in the marker's frame).
  std::vector<PoseCovariance> covariances;
};

/// Finds them by least squares over the corners of all images at once (bundle adjustment: Triggs et
/// al. 2000): Levenberg and Marquardt's method on poses, with the body's poses eliminated, and with
/// Cauchy's weights for corners that do not fit, their scale from the median residual. `state` is
/// the start and is overwritten by the result. Fails if a corner does not project at the start, or
/// if the corners do not determine the unknowns.
Result<BodyFit> adjust(const BodyProblem& problem, BodyState& state);

}  // namespace orthonav::nav
