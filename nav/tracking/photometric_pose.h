#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/tracked.h"
#include "hal/api/devices.h"
#include "nav/tracking/online_calibration.h"
#include "nav/tracking/photometric_reduced.h"
#include "nav/tracking/photometric_view.h"

namespace orthonav::nav {

/// One tag of a tool in one image, with the light remembered for it.
struct TagView {
  const BlurredTag* tag = nullptr;
  Transform<Marker, Tag> marker_from_tag;  ///< poses of a tool are those of its first tag
  bool right = false;                      ///< camera
  Photometry light;
  std::vector<float> cell_weights;  ///< by cell: 0 where it is hidden
  // Of the last fit:
  double kept_fraction = 0.0;  ///< of the pixels, by robust weight
  /// In: whether to use this view at all. Out: whether the fit used it.
  bool used = true;
};

struct PhotometricFit {
  Transform<Rig, Marker> rig_from_marker;
  /// In the frame of the marker: (translation m, rotation vector rad).
  std::array<double, 36> covariance{};
  int views = 0;  ///< sightings used
  bool left = false;
  bool right = false;
  int iterations = 0;
};

/// The pose that explains every sighting at once, since every edge of a tag's cells tells of it:
/// Gauss-Newton over SE(3), each view's light, blur and response eliminated by the Schur
/// complement, weights by Tukey's biweight.
class PhotometricSolver {
 public:
  explicit PhotometricSolver(const StereoCalibration& calibration);

  /// Improves a pose that is right to about half a cell; `doubt_m` says how far off it may be. Only
  /// sightings with `used` set count; their light is updated even if the fit fails. Nothing if too
  /// little of the tags is visible.
  [[nodiscard]] std::optional<PhotometricFit> solve(const StereoFrame& frame,
                                                    const Transform<Rig, Marker>& start,
                                                    double doubt_m, std::span<TagView> views);
  /// The calibration equations of the last fit; nothing if only one camera was used.
  [[nodiscard]] std::optional<CalibrationEquations> calibration_equations(
      const PhotometricFit& fit, std::span<const TagView> views) const;
  /// The equations of one view of the last fit.
  [[nodiscard]] ReducedView view_equations(std::size_t index, const TagView& view) const;
  /// The equations of a view at `pose`, from those at the pose that fits it best.
  [[nodiscard]] static ReducedView shifted(const TagView& view, const ReducedView& at_best,
                                           const Transform<Rig, Marker>& best,
                                           const Transform<Rig, Marker>& pose);
  /// Adds the calibration equations of a tag that both cameras saw, at a pose.
  void add_tag(const Transform<Rig, Marker>& pose, const TagView& left, const ReducedView& of_left,
               const TagView& right, const ReducedView& of_right, CalibrationEquations& out) const;
  /// Pixels per unit of the unit plane, near the middle of the left or the right image.
  [[nodiscard]] double focal_px(bool right) const {
    return right ? right_rays_->focal_px : left_rays_->focal_px;
  }
  /// Turns the right camera by a rotation vector in its own frame.
  void rotate_right_camera(Vec3 rotation_rad) {
    nav::rotate_right_camera(calibration_, rotation_rad);
  }
  [[nodiscard]] const StereoCalibration& calibration() const { return calibration_; }
  /// Camera from tag for a sighting of a tool at a pose.
  [[nodiscard]] CameraFromTag camera_from_tag(const TagView& view,
                                              const Transform<Rig, Marker>& pose) const;

 private:
  struct Step {
    std::array<double, 6> motion{};  ///< of the tool in its own frame: m, rad
    double size_m = 0.0;             ///< how far the motion moves the farthest cells
    double pixels_a_metre = 0.0;     ///< in the nearest view
    double cell_m = 1.0;             ///< of the smallest tag
  };
  std::optional<Step> step(const StereoFrame& frame, double doubt_m, std::span<TagView> views,
                           PhotometricFit& fit);
  bool gather(const StereoFrame& frame, const Transform<Rig, Marker>& pose, double doubt_m,
              TagView& view, ViewEquations& e);
  void update_light(const std::array<double, 6>& step, const Transform<Rig, Marker>& pose,
                    std::span<TagView> views) const;
  bool learn_new_light(std::span<TagView> views) const;
  [[nodiscard]] double pixels_a_metre(const TagView& view,
                                      const Transform<Rig, Marker>& pose) const;
  [[nodiscard]] const CameraModel& camera_of(const TagView& view) const {
    return view.right ? calibration_.right : calibration_.left;
  }

  StereoCalibration calibration_;
  // Copies share them: no rotation of a camera changes its rays.
  std::shared_ptr<const RayTable> left_rays_;
  std::shared_ptr<const RayTable> right_rays_;
  ViewModel model_;
  std::vector<ViewEquations> equations_;
};

}  // namespace orthonav::nav
