#include "nav/registration/surface_fit.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <optional>

namespace orthonav::nav {
namespace {

/// Pose and standoff.
using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector7 = Eigen::Matrix<double, 7, 1>;

/// Tukey's biweight, 87 % efficient at this many SDs.
constexpr double kTukeySd = 3.6;
/// SD from the median of absolute values, for a normal distribution.
constexpr double kSdByMedian = 1.4826;
constexpr double kRelativeDamping = 1e-9;
constexpr double kNowhere_m = 1e3;
/// Allowance for rounding, so that a place at exactly the same distance is found.
constexpr double kRoundingAllowance = 1.0 + 1e-12;

void measure(const SurfaceIndex& surface, std::span<const Vec3> points_m, double farthest_m,
             double tip_radius_m, SurfaceFit& fit) {
  const double height_m = tip_radius_m + fit.standoff_m;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    FittedPoint& out = fit.points[i];
    out.lever_arm_m = fit.pose.rotation * points_m[i];
    const Vec3 query = out.lever_arm_m + fit.pose.centre_m;
    // The nearest place is no farther than the previous nearest one.
    const double within_m =
        std::min(farthest_m, (query - out.nearest_m).norm() * kRoundingAllowance);
    const auto near = surface.nearest(query, within_m);
    if (!near) {
      out.residual_m = farthest_m;
      out.gradient = {};
      out.nearest_m = {kNowhere_m, 0.0, 0.0};
      continue;
    }
    out.nearest_m = near->point_m;
    const Vec3 off = query - near->point_m;
    const double side = off.dot(near->normal) < 0.0 ? -1.0 : 1.0;
    out.residual_m = side * near->distance_m - height_m;
    // On the surface itself, only the face gives a direction.
    out.gradient = near->distance_m > 1e-7 ? (side / near->distance_m) * off : near->normal;
  }
}

double spread_m(const SurfaceFit& fit, std::vector<double>& scratch) {
  scratch.clear();
  for (const FittedPoint& p : fit.points) {
    scratch.push_back(std::abs(p.residual_m));
  }
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  return kSdByMedian * *middle;
}

void weigh(SurfaceFit& fit) {
  for (FittedPoint& p : fit.points) {
    const double z = p.residual_m / (kTukeySd * fit.noise_m);
    const double t = std::max(0.0, 1.0 - z * z);
    p.weight = t * t;
  }
}

/// The length of the step, or nothing when the pose is undetermined.
std::optional<double> step(SurfaceFit& fit) {
  Matrix7 normal = Matrix7::Zero();
  Vector7 right = Vector7::Zero();
  for (const FittedPoint& p : fit.points) {
    if (!(p.weight > 0.0)) {
      continue;
    }
    const Vec3 by_rotation = p.lever_arm_m.cross(p.gradient);
    Vector7 j;
    j << p.gradient.x, p.gradient.y, p.gradient.z, by_rotation.x, by_rotation.y, by_rotation.z,
        -1.0;
    normal.selfadjointView<Eigen::Lower>().rankUpdate(j, p.weight);
    right -= p.weight * p.residual_m * j;
  }
  const double translation_damping = kRelativeDamping * normal.topLeftCorner<3, 3>().trace();
  const double rotation_damping = kRelativeDamping * normal.block<3, 3>(3, 3).trace();
  for (int k = 0; k < 6; ++k) {
    normal(k, k) += k < 3 ? translation_damping : rotation_damping;
  }
  if (!fit.with_standoff) {
    normal.row(6).setZero();
    normal(6, 6) = 1.0;
    right(6) = 0.0;
  }
  const Eigen::LDLT<Matrix7> solver(normal.selfadjointView<Eigen::Lower>());
  const Vector7 x = solver.solve(right);
  if (solver.info() != Eigen::Success || !x.allFinite() || !(normal.trace() > 1.0)) {
    return std::nullopt;
  }
  constexpr double kLongest_m = 0.005;
  constexpr double kLever_m = 0.03;
  const double length = x.head<3>().norm() + kLever_m * x.segment<3>(3).norm() + std::abs(x(6));
  const double scale = std::min(1.0, kLongest_m / std::max(length, 1e-12));
  fit.pose.rotation =
      orthonormalized(rotation_from_vector(scale * Vec3{x(3), x(4), x(5)}) * fit.pose.rotation);
  fit.pose.centre_m += scale * Vec3{x(0), x(1), x(2)};
  fit.standoff_m += scale * x(6);
  return length;
}

}  // namespace

std::optional<SurfaceFit> fit_to_surface(const SurfaceIndex& surface,
                                         std::span<const Vec3> points_m, const CentredPose& start,
                                         const SurfaceFitOptions& options) {
  if (points_m.size() < 6) {
    return std::nullopt;
  }
  SurfaceFit fit;
  fit.pose = start;
  fit.with_standoff = options.with_standoff;
  fit.standoff_m = options.first_standoff_m;
  fit.points.assign(points_m.size(), {{}, {}, {kNowhere_m, 0.0, 0.0}, 0.0, 0.0});
  for (std::size_t i = 0; i < std::min(options.near_m.size(), points_m.size()); ++i) {
    fit.points[i].nearest_m = options.near_m[i];
  }
  std::vector<double> scratch;
  for (bool last = false;; ++fit.iterations) {
    measure(surface, points_m, options.farthest_m, options.tip_radius_m, fit);
    fit.noise_m = std::clamp(spread_m(fit, scratch), options.least_noise_m, options.most_noise_m);
    weigh(fit);
    if (last || fit.iterations == options.max_iterations) {
      return fit;
    }
    const auto length = step(fit);
    if (!length) {
      return std::nullopt;
    }
    last = *length < options.last_step_m;
  }
}

double truncated_cost_m2(const SurfaceFit& fit, double width_m) {
  double sum = 0.0;
  for (const FittedPoint& p : fit.points) {
    const double r = std::min(std::abs(p.residual_m), width_m);
    sum += r * r;
  }
  return sum / static_cast<double>(fit.points.size());
}

}  // namespace orthonav::nav
