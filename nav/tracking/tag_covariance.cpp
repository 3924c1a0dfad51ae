#include <Eigen/Dense>

#include "nav/geometry/matrix_as.h"

#include "nav/tracking/tag_pose.h"

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

constexpr double kStepPx = 0.05;

// How a point of the body moves with a small translation and rotation: [I, -[lever arm]x].
Matrix36 point_by_pose(Vec3 lever_arm) {
  Matrix36 j;
  j.leftCols<3>().setIdentity();
  j.rightCols<3>() = -skew_as<Eigen::Matrix3d>(lever_arm);
  return j;
}

}  // namespace

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
      const Eigen::Vector3d slope = vector_as<Eigen::Vector3d>(*ahead - *behind) / (2.0 * kStepPx);
      noise += variance * slope * slope.transpose();
      return true;
    };
    if (!add({kStepPx, 0}, {}, left_variance_px2) || !add({0, kStepPx}, {}, left_variance_px2) ||
        !add({}, {kStepPx, 0}, right_variance_px2) || !add({}, {0, kStepPx}, right_variance_px2)) {
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
