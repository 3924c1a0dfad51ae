#include "hal/sim/number_reading.h"

#include <array>
#include <cmath>

namespace orthonav::sim {

SpokenDirections spoken_directions(const Transform<Room, Vertebra>& lies, Side side,
                                   Vec3 outwards) {
  const Vec3 head = lies.rotation().column(2);
  const Vec3 patients_left = lies.rotation().column(0);
  SpokenDirections d;
  d.inward = -outwards;
  d.cranial = (head - head.dot(d.inward) * d.inward).normalized();
  const Vec3 across = d.inward.cross(d.cranial);
  const bool to_left = across.dot(patients_left) > 0.0;
  d.medial = to_left == (side == Side::kRight) ? across : -across;
  return d;
}

std::optional<NumberReading> read_numbers(const Eyes& eyes, const SpokenDirections& directions) {
  std::array<double, 4> numbers{};
  if (eyes.readings(HologramKind::kNumbers, numbers) != numbers.size()) {
    return std::nullopt;
  }
  const auto [tip_cranial_m, tip_medial_m, aim_cranial_rad, aim_medial_rad] = numbers;
  const Vec3 aim = directions.inward + std::tan(aim_cranial_rad) * directions.cranial +
                   std::tan(aim_medial_rad) * directions.medial;
  const Vec3 about = aim.cross(directions.inward);
  const double angle_rad = std::atan2(about.norm(), aim.dot(directions.inward));
  const Vec3 rotation_rad = about.norm() > 0.0 ? angle_rad * about.normalized() : Vec3{};
  return NumberReading{tip_cranial_m * directions.cranial + tip_medial_m * directions.medial,
                       {*eyes.seen_at(), rotation_rad}};
}

}  // namespace orthonav::sim
