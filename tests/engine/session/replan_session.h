#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/session/session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_replan_test {

using Kind = ReplanRefusal::Kind;

inline constexpr double kExact = 1e-9;
inline constexpr double kMm = 1e-3;
inline constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};

/// The box's screws are 6 × 35 mm, straight in along -y; its walls are at x = ±30 and z = ±25 mm.
struct Replan4 : test::ScriptedOperation {
  explicit Replan4(const SessionOptions& options = {},
                   Verification verification = Verification::kByEye)
      : ScriptedOperation({"L4", "L5"}, options, verification) {
    registers_within(0.0004);
    tracker().guide = test::guide_at(kLeftEntry + Vec3{0, 0.030, 0}, 0.0);
  }
  const LevelState& level() { return session().levels()[0]; }
  const nav::ScrewPlan& left() { return level().plan.screws[0]; }
  void guides_left() {
    accepts_first_level();
    says("next");
  }
  Kind refusal(const std::string& phrase) {
    const auto* refused = test::said<ReplanRefusal>(says(phrase));
    EXPECT_NE(refused, nullptr) << phrase;
    return refused ? refused->kind : Kind::kNothingToUndo;
  }
};

class SessionReplan : public ::testing::Test {
 protected:
  SessionReplan() { s.guides_left(); }
  Replan4 s;
};

}  // namespace orthonav::engine::session_replan_test
