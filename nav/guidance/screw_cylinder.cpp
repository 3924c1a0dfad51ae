#include "nav/guidance/screw_cylinder.h"

#include <cmath>

namespace orthonav::nav {
namespace {

constexpr double kEntrySought_m = 0.025;

}  // namespace

std::optional<ScrewCylinder> cylinder_of(const ScrewPlan& plan) {
  const Vec3 inward = plan.target - plan.entry;
  const double length_m = inward.norm();
  // Negated, so that NaN is refused too.
  if (!(plan.radius_m > 0.0) || !std::isfinite(plan.radius_m) || !(length_m > 0.0) ||
      !plan.entry.v.is_finite() || !plan.target.v.is_finite()) {
    return std::nullopt;
  }
  return ScrewCylinder{plan.entry, inward / length_m, length_m, plan.radius_m};
}

std::optional<ScrewCylinder> cylinder_along(const Axis<Vertebra>& axis, const ScrewPlan& plan,
                                            const SurfaceIndex& bone) {
  auto screw = cylinder_of(plan);
  const double length = axis.direction.norm();
  if (!screw || !(length > 0.0) || !std::isfinite(length) || !axis.point.v.is_finite()) {
    return std::nullopt;
  }
  const Vec3 inward = axis.direction / length;
  const double abreast_m = (plan.entry - axis.point).dot(inward);
  const Vec3 behind = axis.point.v + (abreast_m - kEntrySought_m) * inward;
  const auto entry = bone.first_hit(behind, inward);
  if (!entry || entry->distance_m > 2.0 * kEntrySought_m || !(entry->normal.dot(inward) < 0.0)) {
    return std::nullopt;
  }
  screw->entry = {entry->point_m};
  screw->direction = inward;
  return screw;
}

std::optional<CylinderSurface> CylinderSurface::of(const ScrewCylinder& screw) {
  if (!(screw.length_m > kFrom_m) || !(screw.radius_m > 0.0)) {
    return std::nullopt;
  }
  return CylinderSurface(screw);
}

CylinderSurface::CylinderSurface(const ScrewCylinder& screw)
    : screw_(screw), side_m_(screw.length_m - kFrom_m) {
  const Vec3 d = screw.direction;
  const Vec3 other = std::abs(d.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  across_ = d.cross(other).normalized();
  athwart_ = d.cross(across_);
}

Vec3 CylinderSurface::outward(double around_rad) const {
  return std::cos(around_rad) * across_ + std::sin(around_rad) * athwart_;
}

double CylinderSurface::around_rad(Vec3 v) const {
  return std::atan2(v.dot(athwart_), v.dot(across_));
}

}  // namespace orthonav::nav
