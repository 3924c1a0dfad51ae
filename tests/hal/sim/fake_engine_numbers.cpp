#include <cmath>
#include <numbers>

#include "tests/hal/sim/fake_engine.h"

namespace orthonav::sim {

void FakeEngine::draw_numbers(ShownFrame& shown, const TestScrew& screw, Vec3 tip_m,
                              Vec3 axis) const {
  // Worked out in the vertebra's own coordinates: x to the patient's left, z to the head.
  const Mat3 vertebra_from_world = world_from_vertebra(screw.level).inverse().rotation();
  const Vec3 inward = (screw.target - screw.entry).normalized();
  const Vec3 tip = vertebra_from_world * tip_m;
  const Vec3 aim = -(vertebra_from_world * axis);
  const Vec3 right_or_left = inward.cross({0, 0, 1}).normalized();
  const Vec3 medial = right_or_left.x * screw.entry.v.x > 0.0 ? -right_or_left : right_or_left;
  const Vec3 across = inward.cross(medial);
  const Vec3 cranial = across.z > 0.0 ? across : -across;
  const auto add = [&](double value, double tenth) {
    const double tenths = std::abs(value) <= 0.5 * tenth ? 0.0 : std::ceil(std::abs(value) / tenth);
    shown.holograms.push_back({.kind = HologramKind::kNumbers,
                               .side = screw.side,
                               .reading = std::copysign(tenths * tenth, value)});
  };
  constexpr double kTenthOfADegree_rad = 0.1 * std::numbers::pi / 180.0;
  add(tip.dot(cranial), 1e-4);
  add(tip.dot(medial), 1e-4);
  add(std::atan2(aim.dot(cranial), aim.dot(inward)), kTenthOfADegree_rad);
  add(std::atan2(aim.dot(medial), aim.dot(inward)), kTenthOfADegree_rad);
}

}  // namespace orthonav::sim
