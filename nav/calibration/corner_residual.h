#pragma once

#include <array>
#include <optional>

#include "base/transform.h"
#include "hal/api/camera_model.h"

namespace orthonav::nav {

/// Derivative of a pixel by a small (translation m, rotation rad) of a pose a_from_b, both in A:
/// two rows.
using PixelByPose = std::array<double, 12>;

/// A corner in one image: the pixel where the poses put it minus the one where it is seen, and the
/// derivatives of that difference.
struct CornerResidual {
  Vec2 off_px;
  PixelByPose by_body{};    ///< by rig_from_marker
  PixelByPose by_tag{};     ///< by marker_from_tag
  PixelByPose by_camera{};  ///< by camera_from_rig
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
  const Vec3 x_by_point{1.0 / p.z, 0.0, -p.x / (p.z * p.z)};
  const Vec3 y_by_point{0.0, 1.0 / p.z, -p.y / (p.z * p.z)};
  for (std::size_t row = 0; row < 2; ++row) {
    const Vec3 by_point = (*slope)[2 * row] * x_by_point + (*slope)[2 * row + 1] * y_by_point;
    const Vec3 in_rig_axes = camera_from_rig.rotation().transposed() * by_point;
    const Vec3 in_marker_axes = rig_from_marker.rotation().transposed() * in_rig_axes;
    // A rotation w moves a point at lever arm a by w × a; the gradient by w is a × g.
    const auto fill = [row](PixelByPose& out, Vec3 gradient, Vec3 lever_arm) {
      const Vec3 by_rotation = lever_arm.cross(gradient);
      for (int i = 0; i < 3; ++i) {
        out[6 * row + static_cast<std::size_t>(i)] = gradient[i];
        out[6 * row + 3 + static_cast<std::size_t>(i)] = by_rotation[i];
      }
    };
    fill(residual.by_camera, by_point, camera_from_rig.rotation() * in_rig.v);
    fill(residual.by_body, in_rig_axes, rig_from_marker.rotation() * in_marker.v);
    fill(residual.by_tag, in_marker_axes, marker_from_tag.rotation() * corner.v);
  }
  return residual;
}

}  // namespace orthonav::nav
