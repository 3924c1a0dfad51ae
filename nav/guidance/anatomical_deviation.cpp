#include "nav/guidance/anatomical_deviation.h"

#include <cmath>
#include <limits>

#include "nav/geometry/matrix_as.h"

namespace orthonav::nav {
namespace {

/// cos(60°)
constexpr double kLeastAlong = 0.5;
constexpr double kUnknown = std::numeric_limits<double>::infinity();

double sd_of_variance(double variance) {
  return variance >= 0.0 ? std::sqrt(variance) : kUnknown;  // NaN counts as unknown too
}

/// A tool's angle in a plane through the planned axis, and its gradient: the axis about which a
/// small turn of the tool changes the angle, scaled by the amount of change.
struct AngleInPlane {
  double angle_rad = 0.0;
  Vec3 by_rotation;
};

AngleInPlane angle_in_plane(Vec3 tool, Vec3 inward, Vec3 across) {
  const double along = tool.dot(inward);
  const double beside = tool.dot(across);
  // d atan2 = (along · d beside - beside · d along) / r², with d tool = turn × tool.
  const Vec3 gradient = (along * across - beside * inward) / (along * along + beside * beside);
  return {std::atan2(beside, along), tool.cross(gradient)};
}

NumberWithSd angle_with_sd(const AngleInPlane& angle, const PoseUncertainty* uncertainty) {
  if (!uncertainty) {
    return {angle.angle_rad, kUnknown};
  }
  // Not a unit direction: its length is how much a turn about it changes the angle.
  const double variance = variance_along(uncertainty->rotation_covariance(), angle.by_rotation);
  return {angle.angle_rad, sd_of_variance(variance)};
}

}  // namespace

std::optional<ScrewDirections> directions_of(const ScrewPlan& plan) {
  constexpr Vec3 kCranial{0, 0, 1};
  ScrewDirections d;
  d.inward = (plan.target - plan.entry).normalized();
  const Vec3 cranial = kCranial - d.inward.z * d.inward;
  // Its length is also the cosine of the angle between the two.
  if (!(cranial.norm() >= kLeastAlong)) {
    return std::nullopt;
  }
  d.cranial = cranial.normalized();
  const Vec3 across = d.inward.cross(d.cranial);
  if (!(std::abs(across.x) >= kLeastAlong)) {
    return std::nullopt;
  }
  // +x is the patient's left, so the midline lies towards -x of a left screw.
  const bool towards_midline = (across.x < 0.0) == (plan.side == Side::kLeft);
  d.medial = towards_midline ? across : -across;
  return d;
}

std::optional<AnatomicalDeviation> anatomical_deviation(const ScrewPlan& plan,
                                                        const Axis<Vertebra>& tool,
                                                        const PoseUncertainty* uncertainty) {
  const auto directions = directions_of(plan);
  if (!directions || !tool.point.v.is_finite() || !tool.direction.is_finite()) {
    return std::nullopt;
  }
  const Vec3 from_entry = tool.point - plan.entry;
  const auto covariance_m2 =
      uncertainty ? uncertainty->covariance_at(tool.point) : std::array<double, 9>{};
  const auto offset = [&](Vec3 direction) {
    return NumberWithSd{
        from_entry.dot(direction),
        uncertainty ? sd_of_variance(variance_along(covariance_m2, direction)) : kUnknown};
  };
  const auto angle = [&](Vec3 across) {
    return angle_with_sd(angle_in_plane(tool.direction, directions->inward, across), uncertainty);
  };
  return AnatomicalDeviation{offset(directions->cranial), offset(directions->medial),
                             angle(directions->cranial), angle(directions->medial),
                             offset(directions->inward)};
}

}  // namespace orthonav::nav
