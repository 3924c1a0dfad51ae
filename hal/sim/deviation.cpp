#include "hal/sim/deviation.h"

#include <cmath>

#include "base/angle.h"

namespace orthonav::sim {
namespace {

constexpr double kDisagreement_rad = 1.0 * kRadiansPerDegree;
constexpr double kShortest_m = 1e-3;

}  // namespace

std::optional<Deviation> read_deviation(const Eyes& eyes) {
  const ShownHologram* triangle = eyes.find(HologramKind::kTriangle);
  const ShownHologram* number = eyes.find(HologramKind::kAngle);
  if (!triangle || triangle->points_in_world.size() != 3 || !number) {
    return std::nullopt;
  }
  const std::optional<double> reading_rad = number->reading;
  if (!reading_rad) {
    return std::nullopt;
  }
  const Point<Room> a = eyes.place(triangle->points_in_world[0]);
  const Vec3 tool = eyes.place(triangle->points_in_world[1]) - a;
  const Vec3 planned = eyes.place(triangle->points_in_world[2]) - a;
  if (!(tool.norm() > kShortest_m && planned.norm() > kShortest_m)) {
    return std::nullopt;
  }
  const double angle_rad = angle_between_rad(tool, planned);
  // Negated, so that NaN disagrees.
  if (!(std::abs(angle_rad - *reading_rad) <= kDisagreement_rad)) {
    return std::nullopt;
  }
  const Vec3 axis = tool.cross(planned);
  const Vec3 turn = axis.norm() > 0.0 ? angle_rad * axis.normalized() : Vec3{};
  return Deviation{*eyes.seen_at(), turn};
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
    sum += back(used++).turn;
  }
  if (used == 0 || used == size()) {
    return std::nullopt;
  }
  return sum / static_cast<double>(used);
}

}  // namespace orthonav::sim
