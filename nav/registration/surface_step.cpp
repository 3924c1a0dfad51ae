#include "nav/registration/surface_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The longest step.
constexpr double kLongestStep_m = 0.008;
constexpr double kWidest_rad = 0.3;
/// Damping relative to the trace: keeps directions that nothing constrains from running away.
constexpr double kDamping = 1e-4;

/// The normal equations of a step, one point at a time. Sums of the lower triangle by rows, then of
/// the right-hand side: plain arrays, since most of the search's time is spent here.
struct StepSums {
  std::array<double, 27> sums{};
  int used = 0;

  void add(Vec3 lever_arm, Vec3 gradient, double residual_m, double weight) {
    const Vec3 by_rotation = lever_arm.cross(gradient);
    const std::array<double, 6> j = {gradient.x,    gradient.y,    gradient.z,
                                     by_rotation.x, by_rotation.y, by_rotation.z};
    std::size_t k = 0;
    for (std::size_t row = 0; row < 6; ++row) {
      const double weighted = weight * j[row];
      for (std::size_t column = 0; column <= row; ++column) {
        sums[k++] += weighted * j[column];
      }
      sums[21 + row] -= weighted * residual_m;
    }
    ++used;
  }
};

/// (translation, rotation vector); not finite where the points do not determine it.
Vector6 damped_step(const StepSums& of) {
  Matrix6 normal;
  Vector6 right;
  std::size_t k = 0;
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) {
      normal(row, column) = normal(column, row) = of.sums[k++];
    }
    right(row) = of.sums[21 + static_cast<std::size_t>(row)];
  }
  const double translation_damping = kDamping * normal.topLeftCorner<3, 3>().trace();
  const double rotation_damping = kDamping * normal.bottomRightCorner<3, 3>().trace();
  for (int i = 0; i < 6; ++i) {
    normal(i, i) += i < 3 ? translation_damping : rotation_damping;
  }
  return normal.ldlt().solve(right);
}

/// Moves the pose by a step, or by as much of it as is allowed at once.
void move_by(const Vector6& step, CentredPose& pose) {
  const double scale = std::min({1.0, kLongestStep_m / std::max(step.head<3>().norm(), 1e-12),
                                 kWidest_rad / std::max(step.tail<3>().norm(), 1e-12)});
  const Vec3 rotation{step(3), step(4), step(5)};
  pose.rotation = orthonormalized(rotation_from_vector(scale * rotation) * pose.rotation);
  pose.centre_m += scale * Vec3{step(0), step(1), step(2)};
}

}  // namespace

Transform<World, Vertebra> world_from(const CentredPose& pose, Vec3 points_centre_m) {
  const Mat3 back = pose.rotation.transposed();
  return {back, points_centre_m - back * pose.centre_m};
}

CentredPose centred(const Transform<World, Vertebra>& pose, Vec3 points_centre_m) {
  const Transform<Vertebra, World> inverse = pose.inverse();
  return {inverse.rotation(), (inverse * Point<World>{points_centre_m}).v};
}

bool FieldStep::improve(std::span<const Vec3> centred_m, double width_m, CentredPose& pose) const {
  StepSums sums;
  const double inverse_width2 = 1.0 / (width_m * width_m);
  for (const Vec3& p : centred_m) {
    const Vec3 lever_arm = pose.rotation * p;
    DistanceField::Value value;
    if (!field_->at(lever_arm + pose.centre_m, value)) {
      continue;
    }
    const double r = value.distance_m - tip_radius_m_;
    const double t = 1.0 - r * r * inverse_width2;
    if (!(t > 0.0)) {
      continue;
    }
    sums.add(lever_arm, value.gradient, r, t * t);
  }
  if (sums.used < 6) {
    return false;
  }
  const Vector6 step = damped_step(sums);
  if (!step.allFinite()) {
    return false;
  }
  move_by(step, pose);
  return true;
}

double FieldStep::cost_m2(std::span<const Vec3> centred_m, double width_m,
                          const CentredPose& pose) const {
  double sum = 0.0;
  for (const Vec3& p : centred_m) {
    DistanceField::Value value;
    const double r = field_->at(pose.rotation * p + pose.centre_m, value)
                         ? std::min(std::abs(value.distance_m - tip_radius_m_), width_m)
                         : width_m;
    sum += r * r;
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, centred_m.size()));
}

}  // namespace orthonav::nav
