#include "nav/registration/tre.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>

#include "base/random.h"
#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using OfMotion = Eigen::Matrix<double, 6, 6>;

/// An uncertainty with more about the same centre.
PoseUncertainty sum_of(const PoseUncertainty& uncertainty, const OfMotion& more) {
  const OfMotion sum = matrix_as<OfMotion>(uncertainty.covariance()) + more;
  return {uncertainty.centre_m(), rows_of<36>(sum)};
}

/// More for the position, along each axis.
PoseUncertainty with_position_variance(const PoseUncertainty& uncertainty, double variance_m2) {
  OfMotion more = OfMotion::Zero();
  more.diagonal().head<3>().setConstant(variance_m2);
  return sum_of(uncertainty, more);
}

}  // namespace

std::array<double, 9> PoseUncertainty::covariance_at(Point<Vertebra> target) const {
  const auto moves = moves_as<Eigen::Matrix<double, 3, 6>>(target.v - centre_m_);
  const Eigen::Matrix3d there = moves * matrix_as<OfMotion>(covariance_) * moves.transpose();
  return rows_of<9>(there);
}

std::array<double, 9> PoseUncertainty::rotation_covariance() const {
  const OfMotion all = matrix_as<OfMotion>(covariance_);
  return rows_of<9>(all.bottomRightCorner<3, 3>());
}

double PoseUncertainty::predicted_tre_m(Point<Vertebra> target) const {
  const std::array<double, 9> c = covariance_at(target);
  return std::sqrt(std::max(0.0, c[0] + c[4] + c[8]));
}

double PoseUncertainty::tre_quantile_m(Point<Vertebra> target, double probability) const {
  const std::array<double, 9> c = covariance_at(target);
  const double mean = c[0] + c[4] + c[8];
  double squares = 0.0;
  for (const double v : c) {
    squares += v * v;
  }
  if (!(mean > 0.0)) {
    return 0.0;
  }
  const double freedom = mean * mean / squares;
  const double k = 2.0 / (9.0 * freedom);
  const double root = std::max(0.0, 1.0 - k + normal_quantile(probability) * std::sqrt(k));
  return std::sqrt(mean * root * root * root);
}

double worst_tre_m(const PoseUncertainty& uncertainty, std::span<const Point<Vertebra>> targets) {
  double worst_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    worst_m = std::max(worst_m, uncertainty.predicted_tre_m(target));
  }
  return worst_m;
}

double CommonErrors::sd_m() const { return std::hypot(tip_m, cameras_m, map_m); }

PoseUncertainty with_common(const PoseUncertainty& own, const CommonErrors& common) {
  return with_position_variance(own, common.sd_m() * common.sd_m());
}
PoseUncertainty with_turn(const PoseUncertainty& own, Point<Vertebra> about, Vec3 axis,
                          double sd_rad) {
  // A rotation w about a place p is w about the centre c plus the shift w x (c - p): one column for
  // each direction across.
  const Vec3 any = std::abs(axis[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = axis.cross(any).normalized();
  OfMotion more = OfMotion::Zero();
  for (const Vec3 rotation : {across, axis.cross(across)}) {
    Eigen::Matrix<double, 6, 1> column;
    column << vector_as<Eigen::Vector3d>(rotation.cross(own.centre_m() - about.v)),
        vector_as<Eigen::Vector3d>(rotation);
    more += sd_rad * sd_rad * column * column.transpose();
  }
  return sum_of(own, more);
}

PoseUncertainty without_common(const PoseUncertainty& all, const CommonErrors& common) {
  return with_position_variance(all, -common.sd_m() * common.sd_m());
}

PoseUncertainty with_tool(const PoseUncertainty& bone,
                          const Transform<Vertebra, World>& vertebra_from_world,
                          Point<Vertebra> origin_in_vertebra, const PoseCovariance& tool_in_world) {
  // About the bone's centre, a motion (t, w) about the tool's origin is (R t + R w × d, R w).
  const auto r = matrix_as<Eigen::Matrix3d>(vertebra_from_world.rotation());
  const auto by_d = skew_as<Eigen::Matrix3d>(bone.centre_m() - origin_in_vertebra.v);
  OfMotion moves;
  moves << r, -by_d * r, Eigen::Matrix3d::Zero(), r;
  return sum_of(bone, moves * matrix_as<OfMotion>(tool_in_world) * moves.transpose());
}

}  // namespace orthonav::nav
