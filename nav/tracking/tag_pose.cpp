#include "nav/tracking/tag_pose.h"

#include <cmath>

#include "nav/geometry/absolute_orientation.h"
#include "nav/geometry/rays.h"

namespace orthonav::nav {

std::array<Vec3, 4> corners_in_marker(double size_m) {
  const double s = size_m / 2.0;
  return {{{-s, -s, 0.0}, {s, -s, 0.0}, {s, s, 0.0}, {-s, s, 0.0}}};
}

TagGeometry::TagGeometry(const StereoCalibration& calibration)
    : calibration_(calibration),
      rig_from_left_(calibration.left_from_rig.inverse()),
      rig_from_right_(calibration.right_from_rig.inverse()) {}

std::optional<Vec3> TagGeometry::corner_in_rig(Vec2 left_px, Vec2 right_px) const {
  const std::optional<Vec2> left = calibration_.left.unproject(left_px);
  const std::optional<Vec2> right = calibration_.right.unproject(right_px);
  if (!left || !right) {
    return std::nullopt;
  }
  const auto meeting = closest_point(
      {rig_from_left_.translation(), rig_from_left_.rotation() * Vec3{left->x, left->y, 1.0}},
      {rig_from_right_.translation(), rig_from_right_.rotation() * Vec3{right->x, right->y, 1.0}});
  if (!meeting) {
    return std::nullopt;
  }
  return meeting->point_m;
}

std::optional<double> TagGeometry::gap_px2(Vec3 in_rig_m, Vec2 left_px, Vec2 right_px) const {
  const Point<Rig> point{in_rig_m};
  const auto left = calibration_.left.project((calibration_.left_from_rig * point).v);
  const auto right = calibration_.right.project((calibration_.right_from_rig * point).v);
  if (!left || !right) {
    return std::nullopt;
  }
  return (*left - left_px).dot(*left - left_px) + (*right - right_px).dot(*right - right_px);
}

std::optional<TagPose> TagGeometry::pose(const TagPair& corners, double size_m) const {
  std::array<Vec3, 4> in_rig_m;
  double gap = 0.0;
  for (std::size_t i = 0; i < in_rig_m.size(); ++i) {
    const auto point_m = corner_in_rig(corners.left_px[i], corners.right_px[i]);
    if (!point_m) {
      return std::nullopt;
    }
    const auto squared = gap_px2(*point_m, corners.left_px[i], corners.right_px[i]);
    if (!squared) {
      return std::nullopt;
    }
    in_rig_m[i] = *point_m;
    gap += *squared;
  }
  const std::array<Vec3, 4> in_marker_m = corners_in_marker(size_m);
  const Result<RigidFit> fit = absolute_orientation(in_marker_m, in_rig_m);
  if (!fit) {
    return std::nullopt;
  }
  double edges_m = 0.0;
  for (std::size_t i = 0; i < in_rig_m.size(); ++i) {
    edges_m += (in_rig_m[(i + 1) % 4] - in_rig_m[i]).norm();
  }
  TagPose pose;
  pose.rig_from_marker = {fit->rotation, fit->translation_m};
  pose.size_ratio = edges_m / (4.0 * size_m);
  pose.fit_rmse_m = fit->rmse_m;
  pose.gap_px = std::sqrt(gap / 8.0);
  return pose;
}

std::optional<double> TagGeometry::residual_px(const Transform<Rig, Marker>& rig_from_marker,
                                               const TagPair& corners, double size_m) const {
  const std::array<Vec3, 4> in_marker_m = corners_in_marker(size_m);
  double sum = 0.0;
  for (std::size_t i = 0; i < in_marker_m.size(); ++i) {
    const Point<Rig> in_rig = rig_from_marker * Point<Marker>{in_marker_m[i]};
    const auto squared = gap_px2(in_rig.v, corners.left_px[i], corners.right_px[i]);
    if (!squared) {
      return std::nullopt;
    }
    sum += *squared;
  }
  return std::sqrt(sum / 8.0);
}

}  // namespace orthonav::nav
