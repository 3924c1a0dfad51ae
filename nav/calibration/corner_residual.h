#pragma once

#include <Eigen/Core>
#include <optional>

#include "base/transform.h"
#include "hal/api/camera_model.h"
#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {

/// Derivative of a pixel by a small (translation m, rotation rad) of a pose a_from_b, both in A.
using PixelByPose = Eigen::Matrix<double, 2, 6>;

/// A corner in one image: the pixel where the poses put it minus the one where it is seen, and the
/// derivatives of that difference.
struct CornerResidual {
  Vec2 off_px;
  PixelByPose by_body = PixelByPose::Zero();    ///< by rig_from_marker
  PixelByPose by_tag = PixelByPose::Zero();     ///< by marker_from_tag
  PixelByPose by_camera = PixelByPose::Zero();  ///< by camera_from_rig
};

/// From tag to marker, to rig, to camera, to pixel; empty if the corner does not project.
template <class Camera>
[[nodiscard]] std::optional<CornerResidual> corner_residual(
    const CameraModel& model, const Transform<Camera, Rig>& camera_from_rig,
    const Transform<Rig, Marker>& rig_from_marker, const Transform<Marker, Tag>& marker_from_tag,
    Point<Tag> corner, Vec2 seen_px, bool derivatives) {
  const Point<Marker> in_marker = marker_from_tag * corner;
  const Point<Rig> in_rig = rig_from_marker * in_marker;
  const Vec3 p = (camera_from_rig * in_rig).v;
  const auto pixel = model.project(p);
  if (!pixel) {
    return std::nullopt;
  }
  CornerResidual residual;
  residual.off_px = *pixel - seen_px;
  if (!derivatives) {
    return residual;
  }
  const auto slope = model.jacobian_px(*pixel);
  if (!slope) {
    return std::nullopt;
  }
  Eigen::Matrix<double, 2, 3> unit_plane;
  unit_plane << 1.0 / p.z, 0.0, -p.x / (p.z * p.z), 0.0, 1.0 / p.z, -p.y / (p.z * p.z);
  const Eigen::Matrix<double, 2, 3> in_camera_axes =
      Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(slope->data()) * unit_plane;
  const Eigen::Matrix<double, 2, 3> in_rig_axes =
      in_camera_axes * matrix_as<Eigen::Matrix3d>(camera_from_rig.rotation());
  const Eigen::Matrix<double, 2, 3> in_marker_axes =
      in_rig_axes * matrix_as<Eigen::Matrix3d>(rig_from_marker.rotation());
  using Moves = Eigen::Matrix<double, 3, 6>;
  residual.by_camera = in_camera_axes * moves_as<Moves>(camera_from_rig.rotation() * in_rig.v);
  residual.by_body = in_rig_axes * moves_as<Moves>(rig_from_marker.rotation() * in_marker.v);
  residual.by_tag = in_marker_axes * moves_as<Moves>(marker_from_tag.rotation() * corner.v);
  return residual;
}

}  // namespace orthonav::nav
