#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/exposure.h"
#include "nav/tracking/photometric_pose.h"
#include "nav/tracking/pose_filter.h"
#include "nav/tracking/tag_search.h"
#include "nav/tracking/tag_size.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// What a pair of images says about a tool.
struct ToolFit {
  Transform<Rig, Marker> rig_from_marker;
  PoseCovariance covariance_in_rig{};
  bool left = false;
  bool right = false;
  std::optional<CalibrationEquations> calibration;  ///< where both cameras saw it
};

/// Finds a tool again near where it is expected and measures it photometrically, in whichever
/// cameras see it. Keeps what it learnt about light and blur. The solver and the search are
/// borrowed scratch.
class ToolFollower {
 public:
  static Result<ToolFollower> create(const ToolGeometry& tool);

  /// Nothing when no image shows the tool's tags within `doubt_m` of where it is expected, or what
  /// is there does not look like them.
  [[nodiscard]] std::optional<ToolFit> follow(const StereoFrame& frame,
                                              const Transform<Rig, Marker>& expected,
                                              double doubt_m, PhotometricSolver& solver,
                                              TagSearch& search);
  /// The fraction by which a tag that both cameras saw in the last fit is larger than stated: each
  /// camera alone tells how far away a tag of the stated size would be, both together tell how far
  /// it is. Nothing when no tag was seen by both.
  [[nodiscard]] std::optional<SizeEvidence> measured_size(const StereoFrame& frame,
                                                          const Transform<Rig, Marker>& pose,
                                                          PhotometricSolver& solver);
  /// How long the cameras expose, as far as the tool's motion has shown.
  [[nodiscard]] double exposure_s() const { return exposure_.exposure_s(); }
  /// Its tags are as large as stated, times this.
  void set_size_factor(double factor);
  /// Forgets the light.
  void forget();

 private:
  ToolFollower() = default;
  Status add(const MarkerDefinition& marker, const Transform<Marker, Tag>& marker_from_tag);
  bool choose_views(const StereoFrame& frame, Transform<Rig, Marker>& pose, double doubt_m,
                    const PhotometricSolver& solver, TagSearch& search);
  [[nodiscard]] bool looks_right(const StereoFrame& frame, const PhotometricFit& fit,
                                 const PhotometricSolver& solver, TagSearch& search) const;
  void learn_exposure(const StereoFrame& frame, const Transform<Rig, Marker>& pose,
                      const PhotometricSolver& solver);

  std::vector<BlurredTag> tags_;
  std::vector<double> stated_sizes_m_;
  std::vector<TagView> views_;     ///< every tag in both cameras
  std::vector<Photometry> light_;  ///< of the views, from the last good fit
  ExposureEstimator exposure_;
  TagView alone_;  ///< scratch
};

}  // namespace orthonav::nav
