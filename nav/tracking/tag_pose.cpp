#include "nav/tracking/tag_pose.h"

#include <cmath>
#include <Eigen/Dense>

#include "nav/geometry/absolute_orientation.h"
#include "nav/geometry/matrix_as.h"
#include "nav/geometry/rays.h"

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

constexpr double kDifferencePx = 0.05;

// How a point of the body moves with a small translation and rotation: [I, -[lever arm]x].
Matrix36 point_by_pose(Vec3 lever_arm) {
  Matrix36 j;
  j.leftCols<3>().setIdentity();
  j.rightCols<3>() = -skew_as<Eigen::Matrix3d>(lever_arm);
  return j;
}

}  // namespace

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

std::optional<PoseCovariance> TagGeometry::covariance(const Transform<Rig, Marker>& rig_from_marker,
                                                      const TagPair& corners, double size_m,
                                                      double left_variance_px2,
                                                      double right_variance_px2) const {
  const std::array<Vec3, 4> in_marker_m = corners_in_marker(size_m);
  Matrix6 normal = Matrix6::Zero();
  Matrix6 spread = Matrix6::Zero();
  for (std::size_t i = 0; i < in_marker_m.size(); ++i) {
    Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
    const auto add = [&](Vec2 left_step, Vec2 right_step, double variance) {
      const auto ahead =
          corner_in_rig(corners.left_px[i] + left_step, corners.right_px[i] + right_step);
      const auto behind =
          corner_in_rig(corners.left_px[i] - left_step, corners.right_px[i] - right_step);
      if (!ahead || !behind) {
        return false;
      }
      const Eigen::Vector3d slope =
          vector_as<Eigen::Vector3d>(*ahead - *behind) / (2.0 * kDifferencePx);
      noise += variance * slope * slope.transpose();
      return true;
    };
    if (!add({kDifferencePx, 0}, {}, left_variance_px2) ||
        !add({0, kDifferencePx}, {}, left_variance_px2) ||
        !add({}, {kDifferencePx, 0}, right_variance_px2) ||
        !add({}, {0, kDifferencePx}, right_variance_px2)) {
      return std::nullopt;
    }
    const Matrix36 j = point_by_pose(rig_from_marker.rotation() * in_marker_m[i]);
    normal += j.transpose() * j;
    spread += j.transpose() * noise * j;
  }
  const Matrix6 inverse = normal.inverse();
  return symmetrized(Matrix6(inverse * spread * inverse));
}

PoseCovariance rotated(const PoseCovariance& covariance, const Mat3& b_from_a) {
  Matrix6 both = Matrix6::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() =
      matrix_as<Eigen::Matrix3d>(b_from_a);
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> in_a(covariance.data());
  return symmetrized(Matrix6(both * in_a * both.transpose()));
}

PoseCovariance plus_carried(const PoseCovariance& own, const PoseCovariance& other,
                            Vec3 lever_arm_m) {
  using ByRows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  ByRows carried = ByRows::Identity();
  carried.topRightCorner<3, 3>() = -skew_as<Eigen::Matrix3d>(lever_arm_m);
  const Eigen::Map<const ByRows> of_own(own.data());
  const Eigen::Map<const ByRows> of_other(other.data());
  return symmetrized(ByRows(of_own + carried * of_other * carried.transpose()));
}

}  // namespace orthonav::nav
