#include "nav/registration/degeneracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Core>
#include <set>

#include "nav/geometry/triangle.h"
#include "nav/statistics/symmetric_eigen.h"

namespace orthonav::nav {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kCovered_m = 0.005;
/// The SD of a place after a few strokes over it.
constexpr double kPinned_m = 0.0003;
/// The spinous process lies within this distance of the midline.
constexpr double kMidline_m = 0.007;
constexpr double kLateral_m = 0.028;
/// Within this distance of the middle, a place is neither upper nor lower.
constexpr double kMiddle_m = 0.006;

Eigen::Matrix<double, 3, 6> moves_at(Vec3 lever_arm) {
  Eigen::Matrix<double, 3, 6> m = Eigen::Matrix<double, 3, 6>::Zero();
  m.leftCols<3>().setIdentity();
  m.rightCols<3>() << 0, lever_arm.z, -lever_arm.y, -lever_arm.z, 0, lever_arm.x, lever_arm.y,
      -lever_arm.x, 0;
  return m;
}

double tre2_m2(const Matrix6& covariance, Vec3 centre_m, std::span<const Point<Vertebra>> targets) {
  double worst = 0.0;
  for (const Point<Vertebra>& target : targets) {
    const auto m = moves_at(target.v - centre_m);
    worst = std::max(worst, (m * covariance * m.transpose()).trace());
  }
  return worst;
}

Vec3 middle(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return (mesh.vertices_m[t[0]] + mesh.vertices_m[t[1]] + mesh.vertices_m[t[2]]) / 3.0;
}

BonePlace place_of(const VertebraModel& model, Vec3 p) {
  using Height = BonePlace::Height;
  using Part = BonePlace::Part;
  const Vec3 centre = model.reachable_axes().centre_m;
  const double x = p.x - centre.x;
  const double z = p.z - centre.z;
  const Height height = z > kMiddle_m    ? Height::kUpper
                        : z < -kMiddle_m ? Height::kLower
                                         : Height::kMiddle;
  if (std::abs(x) < kMidline_m) {
    return {Part::kSpinousProcess, std::nullopt, height};
  }
  return {std::abs(x) > kLateral_m ? Part::kFacet : Part::kLamina,
          x > 0.0 ? Side::kLeft : Side::kRight, height};
}

/// The largest part of a motion at the targets; (translation, rotation) in the vertebra's axes.
UncertainMotion::Kind kind_of(const Vector6& motion, double lever_m) {
  using enum UncertainMotion::Kind;
  constexpr std::array<UncertainMotion::Kind, 6> kKinds = {
      kLateral, kAnteroposterior, kCraniocaudal, kFlexion, kLateralBending, kAxialRotation};
  std::size_t most = 0;
  double length = 0.0;
  for (std::size_t k = 0; k < 6; ++k) {
    const double m = std::abs(motion(static_cast<Eigen::Index>(k))) * (k < 3 ? 1.0 : lever_m);
    if (m > length) {
      length = m, most = k;
    }
  }
  return kKinds[most];
}

std::array<double, 36> entries_of(const Matrix6& matrix) {
  std::array<double, 36> out{};
  Eigen::Map<Matrix6>(out.data()) = matrix;
  return out;
}

/// The motion in whose direction the error at the targets is largest.
UncertainMotion::Kind worst_motion(const Matrix6& covariance, Vec3 centre_m,
                                   std::span<const Point<Vertebra>> targets) {
  Matrix6 at_targets = Matrix6::Zero();
  double lever_m = 0.0;
  for (const Point<Vertebra>& target : targets) {
    const auto m = moves_at(target.v - centre_m);
    at_targets += m.transpose() * m;
    lever_m = std::max(lever_m, (target.v - centre_m).norm());
  }
  // A square root of the covariance: root · rootᵀ.
  const SymmetricEigen6 own = symmetric_eigen(entries_of(covariance));
  const Eigen::Map<const Vector6> variances(own.values.data());
  const Matrix6 root = Eigen::Map<const Matrix6>(own.vectors.data()) *
                       variances.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const SymmetricEigen6 errors = symmetric_eigen(entries_of(root.transpose() * at_targets * root));
  return kind_of(root * Eigen::Map<const Matrix6>(errors.vectors.data()).col(5), lever_m);
}

/// The covariance after one more touch there: Kalman's update.
Matrix6 after_touch(const Matrix6& covariance, Vec3 lever_arm, Vec3 normal) {
  const Vec3 by_rotation = lever_arm.cross(normal);
  Vector6 j;
  j << normal.x, normal.y, normal.z, by_rotation.x, by_rotation.y, by_rotation.z;
  const Vector6 gain = covariance * j;
  return covariance - gain * gain.transpose() / (j.dot(gain) + kPinned_m * kPinned_m);
}

}  // namespace

Degeneracy degeneracy_of(const VertebraModel& model, const PoseUncertainty& uncertainty,
                         std::span<const Point<Vertebra>> targets) {
  const Matrix6 covariance = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(
      uncertainty.covariance().data());
  const Vec3 centre = uncertainty.centre_m();
  const double before = tre2_m2(covariance, centre, targets);
  Degeneracy out;
  out.motion = {worst_motion(covariance, centre, targets), std::sqrt(before)};
  const TriangleMesh& mesh = model.reachable();
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / 400);
  double least = before;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
    const auto& t = mesh.triangles[i];
    const Vec3 at = middle(mesh, t);
    const Vec3 normal =
        triangle_normal({mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]});
    const double now = tre2_m2(after_touch(covariance, at - centre, normal), centre, targets);
    if (now < least) {
      least = now;
      out.stroke_next = place_of(model, at);
      out.stroke_next_at = {at};
    }
  }
  return out;
}

double coverage_fraction(const VertebraModel& model, const SurfaceFit& fit) {
  // Cells that hold a fitted point, and their neighbours.
  const auto cell = [](double x) { return static_cast<int>(std::floor(x / kCovered_m)); };
  std::set<std::array<int, 3>> touched;
  for (const FittedPoint& p : fit.points) {
    if (!(p.weight > 0.0)) {
      continue;
    }
    const Vec3 at = p.lever_arm_m + fit.pose.centre_m;
    touched.insert({cell(at.x), cell(at.y), cell(at.z)});
  }
  const auto near = [&](Vec3 at) {
    for (const double dx : {-0.5, 0.5}) {
      for (const double dy : {-0.5, 0.5}) {
        for (const double dz : {-0.5, 0.5}) {
          if (touched.count({cell(at.x + dx * kCovered_m), cell(at.y + dy * kCovered_m),
                             cell(at.z + dz * kCovered_m)}) != 0) {
            return true;
          }
        }
      }
    }
    return false;
  };
  double covered = 0.0;
  double all = 0.0;
  const TriangleMesh& mesh = model.reachable();
  for (const auto& t : mesh.triangles) {
    const double area =
        triangle_area_m2({mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]});
    all += area;
    if (near(middle(mesh, t))) {
      covered += area;
    }
  }
  return all > 0.0 ? covered / all : 0.0;
}

}  // namespace orthonav::nav
