// Instruments by their roles, and the depth stop of a guide.
#include <gmock/gmock.h>

#include "engine/session/session.h"
#include "engine/session/text/wording.h"
#include "engine/session/tools_in_hand.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_instruments_test {
namespace {

using nav::ToolRole;
using test::guide_at;
using test::pointer_at;
using test::ScriptedOperation;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr Vec3 kFarOff{0.3, 0.3, 0.3};
/// Longer than it takes until a tool is reported.
constexpr int kWhile = 20;

nav::ToolGeometry tap() {
  return {"tap", ToolRole::kTap, {"tag36h11", 9, 0.05}, {{0, -0.150, 0}}, {{0, 1, 0}}};
}

struct WithTap : ScriptedOperation {
  WithTap() : ScriptedOperation({"L4"}, {}, Verification::kByEye, false, false, tap()) {}
  std::string line_with_tap_at(Vec3 tip, int pairs_there = kWhile) {
    tracker().other = pointer_at(tip);
    return detail_text(pairs(pairs_there).status);
  }
};

TEST(ToolSteps, EveryStepOfWorkHasItsToolAndTheGuideAloneIsGuided) {
  for (const auto& [role, step] : {std::pair{ToolRole::kPointer, Step::kDigitize},
                                   {ToolRole::kPointer, Step::kVerify},
                                   {ToolRole::kPointer, Step::kTouchLandmark},
                                   {ToolRole::kGuide, Step::kTouchLandmark},
                                   {ToolRole::kGuide, Step::kGuide},
                                   {ToolRole::kPointer, Step::kRod}}) {
    EXPECT_TRUE(used_in(role, step)) << nav::name_of(role) << " " << name_of(step);
  }
  for (std::size_t role = 0; role < nav::kToolRoles; ++role) {
    if (static_cast<ToolRole>(role) != ToolRole::kPointer &&
        static_cast<ToolRole>(role) != ToolRole::kReference) {
      EXPECT_FALSE(used_in(static_cast<ToolRole>(role), Step::kDigitize)) << role;
    }
  }
  EXPECT_TRUE(used_in(ToolRole::kReference, Step::kDigitize));
}

TEST(Instruments, OneThatTheStepHasNoUseForIsToldOfNearTheBone) {
  WithTap s;
  s.accepts_first_level();
  EXPECT_THAT(s.line_with_tap_at(kLeftEntry + Vec3{0, 0.03, 0}),
              HasSubstr("tap in view: not used in this step"));
  EXPECT_THAT(s.line_with_tap_at(kFarOff), Not(HasSubstr("tap"))) << "laid down";
  EXPECT_THAT(s.line_with_tap_at(kLeftEntry, 5), Not(HasSubstr("tap"))) << "waved by";
  s.says("next");
  EXPECT_THAT(s.line_with_tap_at(kLeftEntry), Not(HasSubstr("tap"))) << "while a screw is placed";
}

TEST(Instruments, WithoutABoneItIsToldOfInPlaceOfTheStepsOwn) {
  WithTap s;
  s.says("start");
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  EXPECT_THAT(s.line_with_tap_at({0, 0, 0}), Not(HasSubstr("tap")));
  s.tracker().pointer.reset();
  EXPECT_THAT(s.line_with_tap_at({0, 0, 0}), HasSubstr("tap in view: not used in this step"));
}

TEST(Instruments, NoneButTheGuideIsGuidedOrDigitizes) {
  WithTap s;
  s.accepts_first_level();
  s.says("next");
  s.tracker().other = guide_at(kLeftEntry, 0.0);
  s.tracker().guide.reset();
  EXPECT_FALSE(s.pairs(kWhile).tool.has_value());
  EXPECT_EQ(s.pair().drill.phase, nav::DrillPhase::kAway);
}

struct WithStop : ScriptedOperation {
  explicit WithStop(double stop_m) : ScriptedOperation({"L4"}) {
    tracker().guide_tool().stop_m = stop_m;
    accepts_first_level();
    says("next");
    tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.040, 0}, 0.0);
  }
};

TEST(DepthStop, ThatIsSetTooDeepIsToldBeforeDrilling) {
  WithStop s(0.0385);  // the screw is 35 mm long
  const Guidance& g = s.pairs(2);
  EXPECT_EQ(g.drill.phase, nav::DrillPhase::kAway);
  ASSERT_TRUE(g.status.stop_past_target_m);
  EXPECT_NEAR(*g.status.stop_past_target_m, 0.0035, 1e-9);
  EXPECT_THAT(detail_text(g.status), HasSubstr("stop lets the drill 4 mm past the target"));
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, -0.001, 0}, 0.0);
  const Guidance& set = s.pairs(kWhile);
  ASSERT_EQ(set.drill.phase, nav::DrillPhase::kSet);
  EXPECT_NEAR(*set.status.stop_past_target_m, 0.0045, 1e-9) << "from where the tip was set";
}

TEST(DepthStop, AtTheTargetOrShortOfItIsNotToldAndTheTwinIs) {
  EXPECT_FALSE(WithStop(0.035).pairs(2).status.stop_past_target_m);
  EXPECT_FALSE(WithStop(0.030).pairs(2).status.stop_past_target_m);
  EXPECT_TRUE(WithStop(0.0352).pairs(2).status.stop_past_target_m);
}

TEST(DepthStop, IsHeldAgainstThePlanInUse) {
  WithStop s(0.034);
  ASSERT_FALSE(s.pairs(2).status.stop_past_target_m);
  const Guidance& g = s.says("length thirty");
  ASSERT_TRUE(g.status.stop_past_target_m) << "in the very pair";
  EXPECT_NEAR(*g.status.stop_past_target_m, 0.004, 1e-9);
  EXPECT_FALSE(s.says("undo").status.stop_past_target_m);
}

TEST(DepthStop, WithoutOneNothingIsSaid) {
  ScriptedOperation s({"L4"});
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry, 0.0);
  EXPECT_FALSE(s.pairs(kWhile).drill.stop_past_target_m);
}

}  // namespace
}  // namespace orthonav::engine::session_instruments_test
