#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "nav/guidance/rod_shape.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::test {

/// To the heads of a left rod with two bends or more, touched one after another.
inline void touches_heads_of_a_rod(ScriptedOperation& s) {
  s.finishes_every_screw();
  for (const Vec3& head : {Vec3{0.02, 0.030, 0.00}, Vec3{0.02, 0.035, 0.04},
                           Vec3{0.02, 0.036, 0.08}, Vec3{0.026, 0.030, 0.12}}) {
    s.touches(head);
  }
}

/// A rod that lies on the table, to be bent and stroked.
struct RodOnTable {
  Vec3 table_m{0.35, -0.10, 0.10};  ///< its first end in World
  Mat3 world_from_rod = rotation_from_vector({0.3, 1.2, -0.5});
  std::vector<nav::RodArc> bends;
  double noise_m = 0.0005;
  Random random{7};

  /// A place on its surface, as the pointer finds it.
  [[nodiscard]] Vec3 felt(double along_m, double about_rad) {
    const nav::RodPlace place = nav::rod_place(bends, along_m);
    const Vec3 out = std::cos(about_rad) * place.line + std::sin(about_rad) * place.beside;
    const Vec3 noise{random.normal(0, noise_m), random.normal(0, noise_m),
                     random.normal(0, noise_m)};
    return world_from_rod * (place.at_m + 0.00275 * out) + table_m + noise;
  }
  /// One of three sides in three seconds.
  const engine::Guidance& is_stroked(ScriptedOperation& s, int side, double from_m, double to_m) {
    constexpr int kPairs = 90;
    const double about_rad = 0.5 + 2.0 * std::numbers::pi / 3.0 * side;
    for (int i = 0; i < kPairs; ++i) {
      const double along_m = from_m + (to_m - from_m) * i / (kPairs - 1);
      s.tracker().pointer = pointer_at(felt(along_m, about_rad));
      i == 0 ? s.does({ClickerAction::kPress}) : s.pair();
    }
    return s.does({ClickerAction::kRelease});
  }
  const engine::Guidance& is_stroked(ScriptedOperation& s, double length_m) {
    is_stroked(s, 0, 0.0, length_m);
    is_stroked(s, 1, 0.0, length_m);
    return is_stroked(s, 2, 0.0, length_m);
  }
  /// The next bend is made as instructed or wrong by this much, stroked and saved.
  const engine::Guidance& is_bent_and_measured(ScriptedOperation& s, double too_far_rad = 0.0) {
    const nav::RodInstructions& told = *s.session().rods()[0].instructions;
    bends.push_back(told.bends[bends.size()].arc);
    bends.back().angle_rad += too_far_rad;
    is_stroked(s, told.cut_length_m());
    return s.says("save");
  }
};

}  // namespace orthonav::test
