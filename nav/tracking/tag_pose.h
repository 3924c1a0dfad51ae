#pragma once

#include <array>
#include <optional>

#include "base/tracked.h"
#include "hal/api/devices.h"

namespace orthonav::nav {

using TagCorners = std::array<Vec2, 4>;

/// A tag as both cameras see it, its corners in the order of `MarkerCorners`.
struct TagPair {
  TagCorners left_px;
  TagCorners right_px;
};

/// A tag's pose from its corners in two images.
struct TagPose {
  Transform<Rig, Marker> rig_from_marker;
  double size_ratio = 0.0;  ///< mean length of the triangulated edges, relative to the size given
  double fit_rmse_m = 0.0;  ///< of the absolute orientation
  double gap_px = 0.0;  ///< RMS distance of the corners from the images of the triangulated ones
};

/// The published geometry (Liebmann et al. 2019, section 3.1): corner → unit plane by the camera's
/// look-up table, closest point between the two rays, absolute orientation. Immutable.
class TagGeometry {
 public:
  explicit TagGeometry(const StereoCalibration& calibration);

  /// Nothing when a corner has no direction, rays do not meet in front of both cameras, or the
  /// corners do not form a plane.
  [[nodiscard]] std::optional<TagPose> pose(const TagPair& corners, double size_m) const;
  /// RMS over the eight corners of the distance between corner and reprojected pose; nothing when
  /// one does not project.
  [[nodiscard]] std::optional<double> residual_px(const Transform<Rig, Marker>& rig_from_marker,
                                                  const TagPair& corners, double size_m) const;
  /// First-order covariance of the pose, in the rig, from independent corner noise of the given
  /// variances (px², per coordinate). Errors of the calibration are not included.
  [[nodiscard]] std::optional<PoseCovariance> covariance(
      const Transform<Rig, Marker>& rig_from_marker, const TagPair& corners, double size_m,
      double left_variance_px2, double right_variance_px2) const;
  [[nodiscard]] const StereoCalibration& calibration() const { return calibration_; }

 private:
  [[nodiscard]] std::optional<Vec3> corner_in_rig(Vec2 left_px, Vec2 right_px) const;
  [[nodiscard]] std::optional<double> gap_px2(Vec3 in_rig_m, Vec2 left_px, Vec2 right_px) const;

  StereoCalibration calibration_;
  Transform<Rig, LeftCamera> rig_from_left_;
  Transform<Rig, RightCamera> rig_from_right_;
};

/// The corners of an upright tag in its own frame, in the order of `MarkerCorners`.
[[nodiscard]] std::array<Vec3, 4> corners_in_marker(double size_m);

/// Where a camera sees the corners of a tag; nothing when one is out of its view.
template <class CameraFrame>
[[nodiscard]] std::optional<TagCorners> corners_seen(
    const CameraModel& camera, const Transform<CameraFrame, Tag>& camera_from_tag, double size_m) {
  TagCorners corners;
  const auto in_tag = corners_in_marker(size_m);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto seen = camera.project((camera_from_tag * Point<Tag>{in_tag[k]}).v);
    if (!seen) {
      return std::nullopt;
    }
    corners[k] = *seen;
  }
  return corners;
}

/// A covariance in frame A expressed in frame B, given A's axes in B.
[[nodiscard]] PoseCovariance rotated(const PoseCovariance& covariance, const Mat3& b_from_a);

/// A pose's own covariance plus that of the pose it is relative to, propagated over the lever arm.
[[nodiscard]] PoseCovariance plus_carried(const PoseCovariance& own, const PoseCovariance& other,
                                          Vec3 lever_arm_m);

}  // namespace orthonav::nav
