#include "nav/guidance/changed_screw.h"

#include <cmath>

#include "nav/guidance/anatomical_deviation.h"

namespace orthonav::nav {
namespace {

/// The same search range for an entry as in nav/guidance/screw_cylinder.
constexpr double kNewEntrySought_m = 0.025;
/// The reachable part is a subset of the bone's surface, so a ray meets both at the same point.
constexpr double kUnchanged_m = 1e-5;

std::optional<Vec3> towards(const ScrewPlan& screw, ScrewDirection direction) {
  const auto directions = directions_of(screw);
  if (!directions) {
    return std::nullopt;
  }
  switch (direction) {
    case ScrewDirection::kCranial:
      return directions->cranial;
    case ScrewDirection::kCaudal:
      return -directions->cranial;
    case ScrewDirection::kMedial:
      return directions->medial;
    case ScrewDirection::kLateral:
      break;
  }
  return -directions->medial;
}

ScrewPlan from_entry(const ScrewPlan& screw, Point<Vertebra> entry, Vec3 inward) {
  ScrewPlan out = screw;
  out.entry = entry;
  out.target = entry + screw_length_m(screw) * inward;
  return out;
}

std::optional<Point<Vertebra>> entry_on(const SurfaceIndex& bone, const SurfaceIndex& reachable,
                                        Vec3 beside_m, Vec3 inward) {
  const Vec3 behind = beside_m - kNewEntrySought_m * inward;
  const auto entry = reachable.first_hit(behind, inward);
  const auto first = bone.first_hit(behind, inward);
  if (!entry || !first || entry->distance_m > 2.0 * kNewEntrySought_m ||
      !(entry->normal.dot(inward) < 0.0) || first->distance_m < entry->distance_m - kUnchanged_m) {
    return std::nullopt;
  }
  return Point<Vertebra>{entry->point_m};
}

}  // namespace

std::optional<ScrewPlan> moved_screw(const ScrewPlan& screw, ScrewPart part,
                                     ScrewDirection direction, double by_m,
                                     const SurfaceIndex& bone, const SurfaceIndex& reachable) {
  const auto to = towards(screw, direction);
  return to ? shifted_screw(screw, part, by_m * *to, bone, reachable) : std::nullopt;
}

std::optional<ScrewPlan> shifted_screw(const ScrewPlan& screw, ScrewPart part, Vec3 by_m,
                                       const SurfaceIndex& bone, const SurfaceIndex& reachable) {
  const Vec3 beside_m = part == ScrewPart::kTarget ? screw.entry.v : screw.entry.v + by_m;
  const Vec3 aim_m = part == ScrewPart::kEntry ? screw.target.v : screw.target.v + by_m;
  const Vec3 inward = (aim_m - beside_m).normalized();
  if (part == ScrewPart::kTarget) {
    return from_entry(screw, screw.entry, inward);
  }
  const auto entry = entry_on(bone, reachable, beside_m, inward);
  return entry ? std::optional(from_entry(screw, *entry, inward)) : std::nullopt;
}

std::optional<ScrewPlan> tilted_screw(const ScrewPlan& screw, ScrewDirection direction,
                                      double by_rad) {
  const auto to = towards(screw, direction);
  if (!to) {
    return std::nullopt;
  }
  const Vec3 inward = (screw.target - screw.entry).normalized();
  return from_entry(screw, screw.entry, std::cos(by_rad) * inward + std::sin(by_rad) * *to);
}

ScrewPlan resized_screw(const ScrewPlan& screw, double radius_m, double new_length_m) {
  ScrewPlan out = screw;
  out.radius_m = radius_m > 0.0 ? radius_m : screw.radius_m;
  if (new_length_m > 0.0) {
    out.target = screw.entry + new_length_m * (screw.target - screw.entry).normalized();
  }
  return out;
}

double screw_length_m(const ScrewPlan& screw) { return (screw.target - screw.entry).norm(); }

ScrewDifference difference_of(const ScrewPlan& before, const ScrewPlan& now) {
  ScrewDifference out;
  const Axis<Vertebra> axis{now.entry, (now.target - now.entry).normalized()};
  if (const auto found = anatomical_deviation(before, axis, nullptr)) {
    out.entry_cranial_m = found->tip_cranial_m.value;
    out.entry_medial_m = found->tip_medial_m.value;
    out.entry_inward_m = found->depth_m.value;
    out.aim_cranial_rad = found->aim_cranial_rad.value;
    out.aim_medial_rad = found->aim_medial_rad.value;
  }
  out.diameter_from_m = 2.0 * before.radius_m;
  out.diameter_to_m = 2.0 * now.radius_m;
  out.length_from_m = screw_length_m(before);
  out.length_to_m = screw_length_m(now);
  return out;
}

double tilt_between_rad(const ScrewPlan& before, const ScrewPlan& now) {
  return angle_between_rad(before.target - before.entry, now.target - now.entry);
}

}  // namespace orthonav::nav
