#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "base/tracked.h"
#include "base/vec.h"
#include "hal/api/devices.h"
#include "nav/tracking/marker_detector.h"
#include "nav/tracking/tool.h"

namespace orthonav::nav {

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

/// The pose of a tag in a camera: camera from marker. Left or right does not matter here.
struct CameraFromTag {
  Mat3 rotation = Mat3::identity();
  Vec3 translation_m{};
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

/// What two sightings must satisfy to be one tag seen by two cameras.
struct MatchLimits {
  /// Distance of the corners from the images of the triangulated ones: one unit's factory
  /// calibration was found to be off by 0.6 px across the epipolar lines; a chance match is off by
  /// tens.
  double gap_px = 2.0;
  /// Deviation of the triangulated size from the tool's, and of the four corners from a square,
  /// both relative to the size.
  double size_fraction = 0.15;
};

/// The sightings of one tag in the two images; null if there is none. Both are set only if they
/// agree with each other and with the tag's size.
struct TagMatch {
  const MarkerCorners* left = nullptr;
  const MarkerCorners* right = nullptr;
  [[nodiscard]] bool both() const { return left && right; }
};

/// The same id may be seen twice in an image (a copy, a misread): of the consistent pairs, the one
/// nearest to the expected position is taken, or, without one, the one decoded best. If only one
/// camera sees the id, that sighting is returned alone; if both do but no pair is consistent,
/// nothing is returned.
[[nodiscard]] TagMatch matched(std::span<const MarkerCorners> left,
                               std::span<const MarkerCorners> right, std::string_view family,
                               int id, double size_m, const TagGeometry& geometry,
                               const std::optional<TagPair>& expected,
                               const MatchLimits& limits = {});

/// The triangulated size of a tag that both cameras see, relative to the size given; nothing if
/// they do not see the same square.
[[nodiscard]] std::optional<double> size_ratio(std::span<const MarkerCorners> left,
                                               std::span<const MarkerCorners> right,
                                               std::string_view family, int id, double size_m,
                                               const TagGeometry& geometry,
                                               const MatchLimits& limits = {});

/// The two poses of a square tag that one camera can't distinguish by its corners: they differ in
/// the direction in which the tag is tilted relative to the line of sight (Collins & Bartoli 2014,
/// "Infinitesimal plane-based pose estimation", on the ambiguity). Each starts at the homography of
/// the corners on the unit plane (Zhang 2000, section 3.1), which is several percent off in
/// distance for noisy corners of a small tag, and is fitted to the corners by least squares; the
/// better fit comes first. The corners are in the order of `MarkerCorners`. Nothing if they do not
/// form a square in front of the camera.
[[nodiscard]] std::optional<std::array<CameraFromTag, 2>> planar_poses(
    const std::array<Vec2, 4>& unit_plane, double size_m);

/// The same in the rig, for a tag whose corners only one camera sees.
[[nodiscard]] std::optional<std::array<Transform<Rig, Tag>, 2>> poses_by_one(
    const StereoCalibration& calibration, const MarkerCorners& seen, bool right, double size_m);

}  // namespace orthonav::nav
