#include <gtest/gtest.h>

#include "tests/engine/session/promising_registration.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::coach_test {
namespace {

using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::state;
using enum ClickerAction;

TEST(CoachedSession, ShowsItBesideThePointsAndRegistersNothingByIt) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch, true);
  s.registration = promising();
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(120);
  const Guidance& g = s.pairs(20);
  ASSERT_NE(state<StrokesSoFar>(g), nullptr);
  EXPECT_EQ(state<StrokesSoFar>(g)->points, 120u);
  ASSERT_NE(state<StrokesSoFar>(g)->coaching, nullptr);
  EXPECT_EQ(state<StrokesSoFar>(g)->coaching->stroke_next, kLeftLamina);
  EXPECT_EQ(g.levels[0].attempts, 0);
  EXPECT_FALSE(g.levels[0].registration.has_value());
  EXPECT_EQ(g.step, Step::kDigitize);
}

TEST(CoachedSession, ARefusalSaysWhatToStrokeNextAndKeepsSayingIt) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch, true);
  s.registration = promising();
  s.registers_first_level();
  const auto* refused = said<RegistrationRefused>(s.pair());
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->stroke_next, kLeftLamina);
  EXPECT_FALSE(refused->another_level_fits);
  s.registration.fits_better = "L3";
  s.registration.reasons = {{nav::RefusalReason::Kind::kFitsOtherLevel, 0.0, 0.0, {}, "L3"}};
  refused = said<RegistrationRefused>(s.does({kDoubleClick}));
  ASSERT_NE(refused, nullptr);
  EXPECT_TRUE(refused->another_level_fits);
}

TEST(CoachedSession, WithoutCoachingThereIsOnlyTheCount) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch, false);
  s.registration = promising();
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(120);
  const auto* strokes = state<StrokesSoFar>(s.pairs(20));
  ASSERT_NE(strokes, nullptr);
  EXPECT_EQ(strokes->points, 120u);
  EXPECT_EQ(strokes->coaching, nullptr);
  EXPECT_TRUE(s.registered_points.empty());
}

}  // namespace
}  // namespace orthonav::engine::coach_test
