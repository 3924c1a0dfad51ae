#include "study/surgeon/deviation.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "study/surgeon/shown_cross.h"

namespace orthonav::sim {
namespace {

constexpr double kDisagreement_rad = 1.0 * kRadiansPerDegree;
constexpr double kShortest_m = 1e-3;
/// A dot nearer to the middle has no direction.
constexpr double kLeastSeen_m = 1e-5;
/// A dot counts as held at the rim from just within it.
constexpr double kNearRim = 0.99;

/// A hologram with that many places, or null.
const ShownHologram* find_places(const Eyes& eyes, HologramKind kind, std::size_t count) {
  const ShownHologram* found = eyes.find(kind);
  return found && found->points_in_world.size() == count ? found : nullptr;
}

/// From a hologram's first place to another one, in the room.
Vec3 from_first(const Eyes& eyes, const ShownHologram& shown, std::size_t to) {
  return eyes.place(shown.points_in_world[to]) - eyes.place(shown.points_in_world[0]);
}

Vec3 rotation_of(Vec3 lean, Vec3 planned, double angle_rad) {
  const Vec3 axis = lean.cross(planned);
  return axis.norm() > 0.0 ? angle_rad * axis.normalized() : Vec3{};
}

}  // namespace

std::optional<Deviation> read_deviation(const Eyes& eyes) {
  const ShownHologram* triangle = find_places(eyes, HologramKind::kTriangle, 3);
  const ShownHologram* cross = find_places(eyes, HologramKind::kCross, 3);
  const ShownHologram* number = eyes.find(HologramKind::kAngle);
  if (!triangle || !cross || !number) {
    return std::nullopt;
  }
  const Vec3 planned = from_first(eyes, *triangle, 2);
  const Vec3 tip = from_first(eyes, *cross, 1) / kCrossScale;
  const Vec3 top = from_first(eyes, *cross, 2) / kCrossScale;
  if (!(planned.norm() > kShortest_m)) {
    return std::nullopt;
  }
  if (std::max(tip.norm(), top.norm()) > kNearRim * kCrossRim_m) {
    const Vec3 lean = from_first(eyes, *triangle, 1) - tip;
    if (!lean.is_finite()) {
      return std::nullopt;
    }
    const double angle_rad = number->reading.value_or(angle_between_rad(lean, planned));
    return Deviation{*eyes.seen_at(), rotation_of(lean, planned, angle_rad)};
  }
  const Vec3 lean = top - tip;
  const double angle_rad = std::asin(std::min(1.0, lean.norm() / kCrossReach_m));
  // Negated, so that NaN disagrees.
  const double number_rad = number->reading.value_or(angle_rad);
  if (!(std::abs(angle_rad - number_rad) <= kDisagreement_rad)) {
    return std::nullopt;
  }
  return Deviation{*eyes.seen_at(), rotation_of(lean, planned, angle_rad)};
}

std::optional<Deviation> read_triangle(const Eyes& eyes) {
  const ShownHologram* triangle = find_places(eyes, HologramKind::kTriangle, 3);
  const ShownHologram* number = eyes.find(HologramKind::kAngle);
  if (!triangle || !number || !number->reading) {
    return std::nullopt;
  }
  const Vec3 planned = from_first(eyes, *triangle, 2);
  const Vec3 lean = from_first(eyes, *triangle, 1);
  if (!(planned.norm() > kShortest_m) || !lean.is_finite()) {
    return std::nullopt;
  }
  return Deviation{*eyes.seen_at(), rotation_of(lean, planned, *number->reading)};
}

std::optional<Vec3> read_tip_offset(const Eyes& eyes, Vec3 outwards) {
  const ShownHologram* cross = find_places(eyes, HologramKind::kCross, 3);
  const ShownHologram* number = eyes.find(HologramKind::kNumbers);
  if (!cross || !number) {
    return std::nullopt;
  }
  const Vec3 dot = from_first(eyes, *cross, 1) / kCrossScale;
  const double offset_m = number->reading.value_or(dot.norm());
  const Vec3 across = dot - dot.dot(outwards) * outwards;
  if (!(across.norm() > kLeastSeen_m)) {
    return Vec3{};
  }
  return offset_m * across.normalized();
}

void DeviationMemory::add(const Deviation& reading) {
  if (count_ > 0 && back(0).seen_at == reading.seen_at) {
    return;
  }
  readings_[count_++ % kKept] = reading;
}

std::optional<Deviation> DeviationMemory::newest(Timestamp until) const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (back(i).seen_at <= until) {
      return back(i);
    }
  }
  return std::nullopt;
}

std::optional<Vec3> DeviationMemory::mean_since(Timestamp since) const {
  Vec3 sum;
  std::size_t used = 0;
  while (used < size() && back(used).seen_at >= since) {
    sum += back(used++).rotation_rad;
  }
  if (used == 0 || used == size()) {
    return std::nullopt;
  }
  return sum / static_cast<double>(used);
}

}  // namespace orthonav::sim
