#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/time.h"
#include "base/vec.h"
#include "hal/api/camera_model.h"
#include "hal/api/devices.h"
#include "nav/tracking/photometric_pose.h"
#include "nav/tracking/pose_filter.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

/// How well an image agrees with a tag at a position, judged at the middles of its cells.
struct CellMatch {
  Vec2 offset_px{};          ///< from where the pose puts the tag
  double correlation = 0.0;  ///< of grey and template, over the cells in the image
  double code = 0.0;         ///< the same over the cells that distinguish ids
  double fraction = 0.0;     ///< of the cells that lie in the image
};

/// Searches for a tag around where a pose puts it, by its bits: a correlation over the middles of
/// its cells, which no change of light affects. Reuses its memory.
class TagSearch {
 public:
  /// The agreement at the pose itself.
  [[nodiscard]] CellMatch match(const GreyImage& image, const CameraModel& camera,
                                const BlurredTag& tag, const CameraFromTag& pose);
  /// The best whole-pixel shift within `radius_px` (at most 40) of the pose last matched.
  [[nodiscard]] CellMatch best_offset(const GreyImage& image, int radius_px) const;

 private:
  [[nodiscard]] CellMatch at(const GreyImage& image, int dx, int dy) const;
  [[nodiscard]] double code_at(const GreyImage& image, Vec2 offset_px) const;

  struct Cell {
    int x_px = 0;
    int y_px = 0;
    float white = 0.0F;
    bool code = false;
  };
  std::vector<Cell> cells_;
  std::size_t all_cells_ = 0;
};

/// The blur and position of a tag in one image: across the edges between its columns and between
/// its rows.
struct BlurSighting {
  std::size_t view = 0;  ///< which tag in which camera
  Timestamp time{};
  Vec2 centre_px{};
  Vec2 column_px{};  ///< from one column to the next
  Vec2 row_px{};
  Vec2 blur_cells{};  ///< SD across columns, across rows
};

/// How long the cameras expose, estimated from the blur of moving tags: the variance of the blur is
/// that of the lens plus v² T² / 12 of the motion, a straight line over v² whose slope is found by
/// least squares with forgetting. Cameras do not report the exposure time, and it changes with the
/// light.
class ExposureEstimator {
 public:
  /// Sightings must come in the order of time. Three consecutive sightings of the same view are
  /// needed.
  void add(const BlurSighting& sighting);
  /// 5 ms until motion has provided an estimate.
  [[nodiscard]] double exposure_s() const;

 private:
  void add(double blur_px2, double speed_px2);

  std::optional<BlurSighting> before_;
  std::optional<BlurSighting> middle_;
  // Sums of x = v²/12 and y, with forgetting.
  double n_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

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
