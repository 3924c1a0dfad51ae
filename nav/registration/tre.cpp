#include "nav/registration/tre.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>

#include "base/random.h"

namespace orthonav::nav {

std::array<double, 9> PoseUncertainty::covariance_at(Point<Vertebra> target) const {
  const Eigen::Matrix<double, 6, 6> covariance =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(covariance_.data());
  const Vec3 d = target.v - centre_m_;
  Eigen::Matrix<double, 3, 6> moves =
      Eigen::Matrix<double, 3, 6>::Zero();  // translation + rotation × d
  moves.leftCols<3>().setIdentity();
  moves.rightCols<3>() << 0, d.z, -d.y, -d.z, 0, d.x, d.y, -d.x, 0;
  std::array<double, 9> out{};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(out.data()) =
      moves * covariance * moves.transpose();
  return out;
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

double CommonErrors::sd_m() const { return std::hypot(tip_m, cameras_m, map_m); }

namespace {
PoseUncertainty with_position_variance(const PoseUncertainty& uncertainty, double variance_m2) {
  auto covariance = uncertainty.covariance();
  for (std::size_t k = 0; k < 3; ++k) {
    covariance[7 * k] += variance_m2;
  }
  return {uncertainty.centre_m(), covariance};
}
}  // namespace

PoseUncertainty with_common(const PoseUncertainty& own, const CommonErrors& common) {
  return with_position_variance(own, common.sd_m() * common.sd_m());
}
PoseUncertainty with_turn(const PoseUncertainty& own, Point<Vertebra> about, Vec3 axis,
                          double sd_rad) {
  // A rotation w about a place p is w about the centre c plus the shift w x (c - p): two columns,
  // one for each direction across.
  auto covariance = own.covariance();
  const Vec3 any = std::abs(axis[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = axis.cross(any).normalized();
  for (const Vec3 rotation : {across, axis.cross(across)}) {
    const Vec3 translation = rotation.cross(own.centre_m() - about.v);
    const std::array<double, 6> column = {translation[0], translation[1], translation[2],
                                          rotation[0],    rotation[1],    rotation[2]};
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) {
        covariance[6 * r + c] += sd_rad * sd_rad * column[r] * column[c];
      }
    }
  }
  return {own.centre_m(), covariance};
}

PoseUncertainty without_common(const PoseUncertainty& all, const CommonErrors& common) {
  return with_position_variance(all, -common.sd_m() * common.sd_m());
}

}  // namespace orthonav::nav
