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
constexpr double kLongest_m = 0.008;
constexpr double kWidest_rad = 0.3;
/// Damping relative to the trace: keeps directions that nothing constrains from running away.
constexpr double kDamping = 1e-4;

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
  // Sums of the lower triangle by rows, then of the right-hand side: plain arrays, since most of
  // the search's time is spent here.
  std::array<double, 27> sums{};
  int used = 0;
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
    const Vec3 g = value.gradient;
    const Vec3 by_rotation = lever_arm.cross(g);
    const std::array<double, 6> j = {g.x, g.y, g.z, by_rotation.x, by_rotation.y, by_rotation.z};
    const double weight = t * t;
    std::size_t k = 0;
    for (std::size_t row = 0; row < 6; ++row) {
      const double weighted = weight * j[row];
      for (std::size_t column = 0; column <= row; ++column) {
        sums[k++] += weighted * j[column];
      }
      sums[21 + row] -= weighted * r;
    }
    ++used;
  }
  if (used < 6) {
    return false;
  }
  Matrix6 normal;
  Vector6 right;
  std::size_t k = 0;
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) {
      normal(row, column) = normal(column, row) = sums[k++];
    }
    right(row) = sums[21 + static_cast<std::size_t>(row)];
  }
  const double translation_damping = kDamping * normal.topLeftCorner<3, 3>().trace();
  const double rotation_damping = kDamping * normal.bottomRightCorner<3, 3>().trace();
  for (int i = 0; i < 6; ++i) {
    normal(i, i) += i < 3 ? translation_damping : rotation_damping;
  }
  const Vector6 step = normal.ldlt().solve(right);
  if (!step.allFinite()) {
    return false;
  }
  const double scale = std::min({1.0, kLongest_m / std::max(step.head<3>().norm(), 1e-12),
                                 kWidest_rad / std::max(step.tail<3>().norm(), 1e-12)});
  const Vec3 rotation{step(3), step(4), step(5)};
  pose.rotation = orthonormalized(rotation_from_vector(scale * rotation) * pose.rotation);
  pose.centre_m += scale * Vec3{step(0), step(1), step(2)};
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
