#include "study/corner_pose.h"

#include <cmath>
#include <Eigen/Dense>

#include "nav/geometry/matrix_as.h"

namespace orthonav::engine {
namespace {

/// The tag's motion in the rig (m, rad about its centre), then the errors of the calibration.
constexpr int kPose = 6;
constexpr int kCalibration = nav::kCalibrationUnknowns;
constexpr int kAll = kPose + kCalibration;
using Normal = Eigen::Matrix<double, kAll, kAll>;
using Right = Eigen::Matrix<double, kAll, 1>;
using Row = Eigen::Matrix<double, 2, kAll>;
using Matrix3 = Eigen::Matrix3d;
constexpr int kIterations = 3;

struct CornerEquations {
  Normal normal = Normal::Zero();
  Right right = Right::Zero();

  /// Corners of one camera. `baseline_m`: of the right one, from it to the left one.
  template <class CameraFrame>
  bool add(const nav::TagCorners& corners_px, const CameraModel& camera,
           const Transform<CameraFrame, Rig>& camera_from_rig, const Transform<Rig, Marker>& pose,
           double size_m, double sd_px, const Vec3* baseline_m) {
    const auto in_marker_m = nav::corners_in_marker(size_m);
    const auto rotation = nav::matrix_as<Matrix3>(camera_from_rig.rotation());
    for (std::size_t k = 0; k < corners_px.size(); ++k) {
      const auto ray = camera.unproject(corners_px[k]);
      const auto slope = camera.jacobian_px(corners_px[k]);
      if (!ray || !slope) {
        return false;
      }
      const Vec3 lever_arm = pose.rotation() * in_marker_m[k];
      const Vec3 p = (camera_from_rig * Point<Rig>{pose.translation() + lever_arm}).v;
      const double focal_px =
          std::sqrt(std::abs((*slope)[0] * (*slope)[3] - (*slope)[1] * (*slope)[2]));
      const double weight = focal_px / sd_px;
      Eigen::Matrix<double, 2, 3> by_point;
      by_point << 1 / p.z, 0, -p.x / (p.z * p.z), 0, 1 / p.z, -p.y / (p.z * p.z);
      Row row = Row::Zero();
      row.leftCols<3>() = by_point * rotation;
      row.middleCols<3>(3) = -by_point * rotation * nav::skew_as<Matrix3>(lever_arm);
      if (baseline_m != nullptr) {
        row.middleCols<3>(kPose) = -by_point * nav::skew_as<Matrix3>(p);
        row.col(kPose + nav::kFocalUnknown) << p.x / p.z, p.y / p.z;
        row.col(kPose + nav::kBaselineUnknown) =
            by_point * nav::vector_as<Eigen::Vector3d>(*baseline_m);
      }
      row.col(kPose + nav::kTagSizeUnknown) =
          by_point * rotation * nav::vector_as<Eigen::Vector3d>(lever_arm);
      const Eigen::Vector2d residual(ray->x - p.x / p.z, ray->y - p.y / p.z);
      normal += weight * weight * row.transpose() * row;
      right += weight * weight * row.transpose() * residual;
    }
    return true;
  }

  [[nodiscard]] nav::CalibrationEquations calibration() const {
    using Square = Eigen::Matrix<double, kCalibration, kCalibration>;
    const auto pose = normal.topLeftCorner<kPose, kPose>().ldlt();
    const Eigen::Matrix<double, kPose, kCalibration> cross =
        normal.topRightCorner<kPose, kCalibration>();
    nav::CalibrationEquations out;
    Eigen::Map<Square>(out.information.data()) =
        normal.bottomRightCorner<kCalibration, kCalibration>() -
        cross.transpose() * pose.solve(cross);
    Eigen::Map<Eigen::Matrix<double, kCalibration, 1>>(out.right.data()) =
        right.tail<kCalibration>() - cross.transpose() * pose.solve(right.head<kPose>());
    return out;
  }
};

}  // namespace

std::optional<CornerPose> corner_pose(const StereoCorners& seen,
                                      const Transform<Rig, Marker>& start,
                                      const StereoCalibration& cameras, double size_m,
                                      double sd_px) {
  CornerPose out;
  out.rig_from_marker = start;
  const Vec3 baseline_m = (cameras.right_from_rig * cameras.left_from_rig.inverse()).translation();
  for (int i = 0;; ++i) {
    CornerEquations e;
    const Transform<Rig, Marker>& pose = out.rig_from_marker;
    const bool added =
        (!seen.left_px ||
         e.add(*seen.left_px, cameras.left, cameras.left_from_rig, pose, size_m, sd_px, nullptr)) &&
        (!seen.right_px || e.add(*seen.right_px, cameras.right, cameras.right_from_rig, pose,
                                 size_m, sd_px, &baseline_m));
    const Eigen::Matrix<double, kPose, kPose> normal = e.normal.topLeftCorner<kPose, kPose>();
    const Eigen::LLT<Eigen::Matrix<double, kPose, kPose>> solver(normal);
    if (!added || solver.info() != Eigen::Success) {
      return std::nullopt;
    }
    if (i == kIterations) {
      Eigen::Map<Eigen::Matrix<double, kPose, kPose, Eigen::RowMajor>>(out.covariance.data()) =
          solver.solve(Eigen::Matrix<double, kPose, kPose>::Identity());
      if (seen.left_px && seen.right_px) {
        out.calibration = e.calibration();
      }
      return out;
    }
    const Eigen::Matrix<double, kPose, 1> step = solver.solve(e.right.head<kPose>());
    out.rig_from_marker =
        nav::displaced(pose, {step[0], step[1], step[2]}, {step[3], step[4], step[5]});
  }
}

}  // namespace orthonav::engine
