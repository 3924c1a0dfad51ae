#pragma once

#include <gtest/gtest.h>

#include "engine/session/session.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_placed_test {

/// The places touched to verify the registration move it by micrometres.
inline constexpr double kJoined = 1e-5;
inline constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
/// SD of the registration along each axis.
inline constexpr double kRegistration_m = 0.0003;

/// In `measure`: the first screw was drilled, and "next" was said. World is Vertebra.
class PlacedSession : public ::testing::Test {
 protected:
  explicit PlacedSession(const SessionOptions& options = {}, bool reference = false,
                         double registration_m = kRegistration_m)
      : s({"L4", "L5"}, options, Verification::kByTouch, false, reference) {
    if (registration_m > 0.0) {
      s.registers_within(registration_m);
    }
    s.accepts_first_by_touch();
    drill();
  }
  void drill() {
    s.touches_landmark();
    s.says("next");
    s.tracker().guide = test::guide_at(kLeftEntry, 0.0);
    s.pairs(3);
    s.says("next");
  }
  /// A click with the sleeve over a wire that passes the entry `beside_m` towards +x and is tilted
  /// by `angle_rad`; `out_m` of it lie between sleeve and entry.
  const Guidance& measures(double beside_m, double angle_rad, double out_m = 0.004) {
    set_over(beside_m, angle_rad, out_m);
    s.does({ClickerAction::kPress});
    s.pair();
    return s.does({ClickerAction::kRelease, ClickerAction::kClick});
  }
  void set_over(double beside_m, double angle_rad, double out_m = 0.004) {
    const Vec3 out = rotation_from_vector({0, 0, angle_rad}) * Vec3{0, 1, 0};
    const Vec3 across = rotation_from_vector({0, 0, angle_rad}) * Vec3{1, 0, 0};
    s.tracker().guide = test::guide_at(kLeftEntry + beside_m * across + out_m * out, angle_rad);
  }
  const LevelState& level() { return s.session().levels()[0]; }
  test::ScriptedOperation s;
};

}  // namespace orthonav::engine::session_placed_test
