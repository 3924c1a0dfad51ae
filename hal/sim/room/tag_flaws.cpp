#include "hal/sim/room/tag_flaws.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace orthonav::sim {
namespace {

/// How sharply a matt print mirrors: half of it within 15 degrees. Estimate.
constexpr double kSharpness = 80.0;
/// Mains lamps peak twice in each of the 50 periods per second.
constexpr double kFlicker_hz = 100.0;
/// A drop may lie anywhere on the plate, which is a little larger than the tag.
constexpr double kPlateOverTag = 1.3;
constexpr int kMaxDrops = 20;

/// Poisson, by counting (Knuth 1969).
int drops(Random& random, double mean) {
  double left = random.uniform();
  int count = 0;
  for (const double none = std::exp(-mean); left > none && count < kMaxDrops; ++count) {
    left *= random.uniform();
  }
  return count;
}

}  // namespace

Vec3 lamp_in_room() { return Vec3{0.24, 0.94, 0.24}.normalized(); }

double height_m(const TagFlaws& flaws, double size_m, Vec2 place_m) {
  const double half_m = 0.5 * size_m;
  const double u =
      (std::cos(flaws.bow_rad) * place_m.x + std::sin(flaws.bow_rad) * place_m.y) / half_m;
  return flaws.bow_m * (u * u - 1.0 / 3.0);
}

double glare(double gloss, Vec3 normal, Vec3 to_lamp, Vec3 to_viewer) {
  if (gloss == 0.0) {
    return 0.0;
  }
  const double mirrored = normal.dot((to_lamp + to_viewer).normalized());
  return gloss * std::pow(std::max(0.0, mirrored), kSharpness);
}

double flicker(const ErrorModel& error_model, double time_s) {
  const double phase_rad = std::numbers::pi * kFlicker_hz * error_model.exposure_s;
  const double kept = phase_rad > 0.0 ? std::sin(phase_rad) / phase_rad : 1.0;
  return 1.0 +
         error_model.light_flicker * kept * std::sin(2.0 * std::numbers::pi * kFlicker_hz * time_s);
}

bool covers_a_corner(const TagFlaws& flaws, double size_m) {
  const double half_m = 0.5 * size_m;
  return std::any_of(flaws.drops.begin(), flaws.drops.end(), [half_m](const TagDrop& drop) {
    const Vec2 off_m{std::abs(drop.place_m.x) - half_m, std::abs(drop.place_m.y) - half_m};
    return off_m.norm() < drop.radius_m;
  });
}

RoomDescription with_flawed_tags(RoomDescription room, const ErrorModel& error_model,
                                 const Random& random) {
  room.tag_flaws.clear();
  for (std::size_t i = 0; i < room.tools.size(); ++i) {
    Random own = random.fork(i);
    TagFlaws flaws;
    flaws.bow_m = own.normal(0.0, error_model.tag_bow_m);
    flaws.bow_rad = own.uniform(0.0, std::numbers::pi);
    const double half_m = 0.5 * kPlateOverTag * room.tools[i].size_m;
    for (int drop = drops(own, error_model.drops_per_tag); drop > 0; --drop) {
      const double x = own.uniform(-half_m, half_m);
      const double y = own.uniform(-half_m, half_m);
      flaws.drops.push_back({{x, y}, 0.5 * error_model.drop_m});
    }
    room.tag_flaws.push_back(std::move(flaws));
  }
  return room;
}

}  // namespace orthonav::sim
