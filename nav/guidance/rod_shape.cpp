#include "nav/guidance/rod_shape.h"

#include <algorithm>
#include <cmath>

namespace orthonav::nav {
namespace {

constexpr int kChordsOfArc = 8;
/// Below this angle the series of sine and cosine is exact enough.
constexpr double kNearlyStraight_rad = 1e-4;

RodPlace beyond_arc(const RodPlace& from, double width_m, double angle_rad, double roll_rad) {
  const Vec3 towards = std::cos(roll_rad) * from.line + std::sin(roll_rad) * from.beside;
  const bool straight = std::abs(angle_rad) < kNearlyStraight_rad;
  const double forward =
      straight ? 1.0 - angle_rad * angle_rad / 6.0 : std::sin(angle_rad) / angle_rad;
  const double aside = straight ? 0.5 * angle_rad : (1.0 - std::cos(angle_rad)) / angle_rad;
  const Mat3 rotation = rotation_from_vector(angle_rad * from.along.cross(towards));
  return {from.at_m + width_m * (forward * from.along + aside * towards), rotation * from.line,
          rotation * from.beside, rotation * from.along};
}

}  // namespace

std::vector<RodStraight> rod_straights(std::span<const RodArc> arcs, double length_m) {
  std::vector<RodStraight> straights;
  RodPlace place;
  double begin_m = 0.0;
  for (const RodArc& arc : arcs) {
    const double end_m = arc.centre_m - 0.5 * arc.width_m;
    straights.push_back({place.at_m, place.along, begin_m, end_m});
    place.at_m += (end_m - begin_m) * place.along;
    place = beyond_arc(place, arc.width_m, arc.angle_rad, arc.roll_rad);
    begin_m = end_m + arc.width_m;
  }
  straights.push_back({place.at_m, place.along, begin_m, length_m});
  return straights;
}

RodPlace rod_place(std::span<const RodArc> arcs, double at_m) {
  RodPlace place;
  double begin_m = 0.0;
  for (const RodArc& arc : arcs) {
    const double bent_from_m = arc.centre_m - 0.5 * arc.width_m;
    if (at_m <= bent_from_m) {
      break;
    }
    place.at_m += (bent_from_m - begin_m) * place.along;
    const double part = std::min(1.0, (at_m - bent_from_m) / arc.width_m);
    place = beyond_arc(place, part * arc.width_m, part * arc.angle_rad, arc.roll_rad);
    begin_m = bent_from_m + part * arc.width_m;
  }
  place.at_m += (at_m - begin_m) * place.along;
  return place;
}

std::vector<Vec3> rod_axis(std::span<const RodArc> arcs, double length_m) {
  std::vector<Vec3> axis = {Vec3{}};
  RodPlace place;
  double begin_m = 0.0;
  for (const RodArc& arc : arcs) {
    const double end_m = arc.centre_m - 0.5 * arc.width_m;
    place.at_m += (end_m - begin_m) * place.along;
    axis.push_back(place.at_m);
    for (int i = 1; i <= kChordsOfArc; ++i) {
      const double part = static_cast<double>(i) / kChordsOfArc;
      axis.push_back(
          beyond_arc(place, part * arc.width_m, part * arc.angle_rad, arc.roll_rad).at_m);
    }
    place = beyond_arc(place, arc.width_m, arc.angle_rad, arc.roll_rad);
    begin_m = end_m + arc.width_m;
  }
  axis.push_back(place.at_m + (length_m - begin_m) * place.along);
  return axis;
}

}  // namespace orthonav::nav
