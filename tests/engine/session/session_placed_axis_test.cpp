#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "engine/session/text/wording.h"
#include "tests/engine/session/placed_session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_placed_test {
namespace {

using test::guide_at;
using test::said;
using test::ScriptedOperation;
using test::step_of;
using ::testing::HasSubstr;
using enum ClickerAction;

/// A wire as planned, over which a guide whose axis is off by `off_rad` was turned to and fro by up
/// to `turn_rad`.
const Guidance& measures_turning(ScriptedOperation& s, double off_rad, double turn_rad) {
  constexpr int kPairs = 45;
  const Mat3 off = rotation_from_vector({0, 0, off_rad});
  for (int k = 0; k <= kPairs; ++k) {
    const double roll_rad = turn_rad * std::sin(2.0 * std::numbers::pi * k / kPairs);
    const Mat3 turn = rotation_from_vector({0, roll_rad, 0}) * off.transposed();
    const Vec3 tip = kLeftEntry + Vec3{0, 0.004, 0};
    s.tracker().guide = {turn, tip - turn * guide_at({}, 0.0).inverse().translation()};
    s.pair();
  }
  s.pairs(20);
  s.does({kPress});
  s.pair();
  return s.does({kRelease, kClick});
}

TEST_F(PlacedSession, ATurnedSleeveTellsTheWireWithoutTheGuidesAxis) {
  const double off_rad = 0.02;
  const Guidance& turned = measures_turning(s, off_rad, 1.0);
  ASSERT_NE(turned.wire, nullptr);
  // The error of the guide's axis is found to one fiftieth.
  EXPECT_NEAR(turned.wire->axis.angle_rad.value, 0.0, 0.02 * off_rad);
  EXPECT_LT(turned.wire->axis.angle_rad.sd, PlacedWireRules{}.axis_sd_rad);
  const Guidance& still = measures_turning(s, off_rad, 0.0);
  // An earlier turn is still within the last ten seconds, unless the sleeve was elsewhere.
  ASSERT_NE(still.wire, nullptr);
  set_over(0.0, 0.3);
  s.pair();
  EXPECT_NEAR(measures_turning(s, off_rad, 0.0).wire->axis.angle_rad.value, off_rad, kJoined)
      << "the twin";
}

TEST_F(PlacedSession, TheAxisIsCorrectedWithConsentBeforeTheNextScrew) {
  measures_turning(s, 0.02, 1.0);
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
  s.says("accept");
  EXPECT_EQ(said<AxisCorrected>(s.pair()), nullptr) << "nothing was offered yet";
  s.touches_landmark();
  EXPECT_EQ(said<AxisCorrected>(s.pair()), nullptr) << "not without a word";
  EXPECT_THAT(detail_text(s.pair().status),
              HasSubstr("guide's axis 1.1° off: say accept result to correct it"));
  s.says("accept");
  ASSERT_NE(said<AxisCorrected>(s.pair()), nullptr);
  EXPECT_EQ(detail_text(s.pair().status), "axis corrected by 1.1°");
  // The mean by the described axis (0.57 degrees) and by the spin.
  EXPECT_GT(said<AxisCorrected>(s.pair())->by_rad, 0.019);
  EXPECT_LT(said<AxisCorrected>(s.pair())->by_rad, 0.02);
  EXPECT_EQ(detail_text(s.pairs(90).status), "now the guide's tip") << "once it was read";
}

TEST_F(PlacedSession, AnAxisThatIsRightIsLeftAlone) {
  measures_turning(s, 0.001, 1.0);
  s.says("next");
  s.touches_landmark();
  s.says("accept");
  EXPECT_EQ(said<AxisCorrected>(s.pair()), nullptr);
}

}  // namespace
}  // namespace orthonav::engine::session_placed_test
