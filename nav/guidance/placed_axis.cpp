#include "nav/guidance/placed_axis.h"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

using Covariance = std::array<double, 9>;

/// A deviation shorter than this has no meaningful direction: micrometres, or microradians.
constexpr double kNone = 1e-6;

/// SD of the length of a deviation across `axis`, from the errors across it.
double sd_of_length(const Covariance& covariance, Vec3 deviation, Vec3 axis) {
  const double length = deviation.norm();
  if (length > kNone) {
    return std::sqrt(variance_along(covariance, deviation / length));
  }
  const double all = covariance[0] + covariance[4] + covariance[8];
  return std::sqrt(std::max(0.0, all - variance_along(covariance, axis)) / 2.0);
}

void add_across(Covariance& covariance, Vec3 axis, double variance) {
  const auto e = vector_as<Eigen::Vector3d>(axis);
  Eigen::Map<Eigen::Matrix3d>(covariance.data()) +=
      variance * (Eigen::Matrix3d::Identity() - e * e.transpose());
}

}  // namespace

PlacedAxis placed_axis(const ScrewPlan& plan, const Axis<Vertebra>& sleeve,
                       const PoseUncertainty& pose, const SleeveErrors& errors) {
  const Vec3 inward = (plan.target - plan.entry).normalized();
  const Vec3 direction = sleeve.direction.normalized();
  const double way_m = (plan.entry - sleeve.point).dot(direction);
  PlacedAxis out;
  out.line = {sleeve.point + way_m * direction, direction};
  const double axis_variance = errors.axis_rad * errors.axis_rad;
  out.direction_covariance_rad2 = pose.rotation_covariance();
  add_across(out.direction_covariance_rad2, direction, axis_variance);
  out.point_covariance_m2 = pose.covariance_at(out.line.point);
  add_across(out.point_covariance_m2, direction,
             errors.tip_m * errors.tip_m + way_m * way_m * axis_variance);
  const Vec3 about = inward.cross(direction);
  out.angle_rad = {std::atan2(about.norm(), inward.dot(direction)),
                   sd_of_length(out.direction_covariance_rad2, about, direction)};
  const Vec3 off_m = out.line.point - plan.entry;
  out.entry_m = {off_m.norm(), sd_of_length(out.point_covariance_m2, off_m, direction)};
  return out;
}

}  // namespace orthonav::nav
