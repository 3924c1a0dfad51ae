#include "nav/geometry/absolute_orientation.h"

#include <cmath>
#include <Eigen/Dense>
#include <string>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

// Points this close to a line, relative to their length along it, leave the rotation about the line
// to rounding and noise.
constexpr double kCollinear = 1e-4;

bool all_finite(std::span<const Vec3> points) {
  for (const Vec3& p : points) {
    if (!p.is_finite()) {
      return false;
    }
  }
  return true;
}

Vec3 centroid(std::span<const Vec3> points) {
  Vec3 sum;
  for (const Vec3& p : points) {
    sum += p;
  }
  return sum / static_cast<double>(points.size());
}

bool is_collinear(std::span<const Vec3> points, Vec3 centre) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) {
    const auto d = vector_as<Eigen::Vector3d>(p - centre);
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter, Eigen::EigenvaluesOnly);
  const double longest = solver.eigenvalues()(2);
  return !(longest > 0.0) || solver.eigenvalues()(1) <= kCollinear * kCollinear * longest;
}

Mat3 best_rotation(std::span<const Vec3> from, Vec3 from_centre, std::span<const Vec3> to,
                   Vec3 to_centre) {
  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    s += vector_as<Eigen::Vector3d>(from[i] - from_centre) *
         vector_as<Eigen::Vector3d>(to[i] - to_centre).transpose();
  }
  // Horn's N: its largest eigenvector is the quaternion (w, x, y, z).
  const Eigen::Vector3d turn(s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0));
  Eigen::Matrix4d n;
  n << s.trace(), turn.transpose(),  //
      turn, s + s.transpose() - s.trace() * Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(n);
  const Eigen::Vector4d q = solver.eigenvectors().col(3);
  return rotation_from_quaternion({q(1), q(2), q(3), q(0)});
}

}  // namespace

Result<RigidFit> absolute_orientation(std::span<const Vec3> from_m, std::span<const Vec3> to_m) {
  if (from_m.size() != to_m.size()) {
    return Error{"absolute orientation: " + std::to_string(from_m.size()) + " points onto " +
                 std::to_string(to_m.size()) + ", the counts must be equal"};
  }
  if (from_m.size() < 3) {
    return Error{"absolute orientation: " + std::to_string(from_m.size()) +
                 " points, at least 3 are needed"};
  }
  if (!all_finite(from_m) || !all_finite(to_m)) {
    return Error{"absolute orientation: a point is not finite"};
  }
  const Vec3 from_centre = centroid(from_m);
  const Vec3 to_centre = centroid(to_m);
  if (is_collinear(from_m, from_centre) || is_collinear(to_m, to_centre)) {
    return Error{
        "absolute orientation: the points lie on a line, rotation about it is undetermined"};
  }

  RigidFit fit;
  fit.rotation = best_rotation(from_m, from_centre, to_m, to_centre);
  fit.translation_m = to_centre - fit.rotation * from_centre;
  double squared = 0.0;
  for (std::size_t i = 0; i < from_m.size(); ++i) {
    squared += (fit.rotation * from_m[i] + fit.translation_m - to_m[i]).squared_norm();
  }
  fit.rmse_m = std::sqrt(squared / static_cast<double>(from_m.size()));
  if (!std::isfinite(fit.rmse_m)) {
    return Error{"absolute orientation: the points are too large"};
  }
  return fit;
}

}  // namespace orthonav::nav
