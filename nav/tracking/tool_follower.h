#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "nav/tracking/exposure.h"
#include "nav/tracking/photometric_pose.h"
#include "nav/tracking/pose_filter.h"
#include "nav/tracking/tag_search.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// The result of fitting a tool to a pair of images.
struct ToolFit {
  Transform<Rig, Marker> rig_from_marker;
  PoseCovariance covariance_in_rig{};
  bool left = false;
  bool right = false;
  /// Where both cameras saw it, even if only one of them at this pose.
  std::optional<CalibrationEquations> calibration;
};

/// Finds a tool near its expected pose and measures it photometrically, with all cameras that see
/// it. Keeps its estimates of light and blur. Solver and search are borrowed as scratch.
class ToolFollower {
 public:
  static Result<ToolFollower> create(const ToolGeometry& tool);

  /// Nothing if no image shows the tool's tags within `doubt_m` of the expected pose, or if the
  /// image there does not look like them.
  [[nodiscard]] std::optional<ToolFit> follow(const StereoFrame& frame,
                                              const Transform<Rig, Marker>& expected,
                                              double doubt_m, PhotometricSolver& solver,
                                              TagSearch& search);
  /// The cameras' exposure time, estimated from the tool's motion.
  [[nodiscard]] double exposure_s() const { return exposure_.exposure_s(); }
  /// Sets the factor on the stated size of its tags.
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
  /// The calibration equations from what each camera says alone, at the pose of a fit: where the
  /// pictures contradict each other, a robust fit to both leaves out what does. Nothing if no tag
  /// is seen by both.
  [[nodiscard]] std::optional<CalibrationEquations> equations_alone(const StereoFrame& frame,
                                                                    const PhotometricFit& fit,
                                                                    PhotometricSolver& solver,
                                                                    TagSearch& search);
  void learn_exposure(const StereoFrame& frame, const Transform<Rig, Marker>& pose,
                      const PhotometricSolver& solver);

  std::vector<BlurredTag> tags_;
  std::vector<double> stated_sizes_m_;
  std::vector<TagView> views_;     ///< every tag in both cameras
  std::vector<Photometry> light_;  ///< of the views, from the last good fit
  /// Where each view alone puts the tool, if its tag was found near where it is expected.
  std::vector<std::optional<Transform<Rig, Marker>>> found_;
  ExposureEstimator exposure_;
  TagView alone_;  ///< scratch
};

}  // namespace orthonav::nav
