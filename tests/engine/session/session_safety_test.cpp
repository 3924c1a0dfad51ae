#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/session/session.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_safety_test {
namespace {

using test::guide_at;
using test::notice_of;
using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using enum ClickerAction;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
// Arithmetic on values of the order of 1: far below what any device resolves.
constexpr double kExact = 1e-9;

/// Strokes up to the double click that asks for the registration.
void digitizes(ScriptedOperation& s) {
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  s.says("save");
}

TEST(Accept, IsRefusedInTheBatchOfTheRegistrationItself) {
  ScriptedOperation s;
  digitizes(s);
  s.hears_at(s.now() + std::chrono::milliseconds(20), "accept");
  const Guidance& g = s.does({kDoubleClick});
  EXPECT_EQ(step_of(g), "verify L4");
  EXPECT_FALSE(g.levels[0].accepted);
  EXPECT_EQ(notice_of(g), Notice::kSaidTooEarly);
  EXPECT_EQ(step_of(s.accepts()), "landmark L4") << "said again, it counts";
}

TEST(Accept, IsRefusedWhenItWasSaidBeforeAndUnderstoodLate) {
  ScriptedOperation s;
  digitizes(s);
  const Timestamp before = s.now();
  const Guidance& verifying = s.does({kDoubleClick});
  const Timestamp visible = verifying.display_time;
  s.pairs(10);
  s.hears_at(before, "accept");
  EXPECT_EQ(s.pair().step, Step::kVerify);
  s.hears_at(visible - Duration(1), "accept");
  EXPECT_EQ(s.pair().step, Step::kVerify);
  s.hears_at(visible, "accept");
  EXPECT_EQ(s.pair().step, Step::kTouchLandmark);
}

TEST(Accept, MustFollowTheNewRegistrationNotTheOneBeforeIt) {
  ScriptedOperation s;
  digitizes(s);
  s.does({kDoubleClick});
  s.pairs(3);
  s.says("reject");
  s.strokes(5);
  s.says("save");
  s.hears_at(s.now() + std::chrono::milliseconds(20), "accept");
  EXPECT_EQ(s.does({kDoubleClick}).step, Step::kVerify);
}

class Guided : public ::testing::Test {
 protected:
  Guided() {
    s.accepts_first_level();
    s.says("next");
    s.tracker().guide = guide_at(kLeftEntry, 0.1);
    s.pairs(3);
  }
  ScriptedOperation s;
};

TEST_F(Guided, APredictedPoseGivesAnOverlayButNoNumber) {
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const Guidance& g = s.pair();
  ASSERT_TRUE(g.tool.has_value());
  EXPECT_FALSE(g.tool->measured.has_value());
  EXPECT_NEAR(g.tool->shown.angle_rad, 0.1, kExact);
  s.tracker().guide_origin = PoseStatus::kMeasured;
  EXPECT_TRUE(s.pair().tool->measured.has_value());
}

TEST_F(Guided, APredictionIsShownNoLongerThanItsMeasurementIsFresh) {
  s.tracker().guide_origin = PoseStatus::kPredicted;
  // 33 ms a pair, lit up 16 ms later: the second still lights up 83 ms after the measurement.
  EXPECT_TRUE(s.pairs(2).tool.has_value());
  EXPECT_FALSE(s.pair().tool.has_value());
}

TEST_F(Guided, SaysWhenTheTagIsNotAsLargeAsStated) {
  s.tracker().size = nav::TagSize{-0.032, 0.001, 12, true, false};
  EXPECT_FALSE(s.pair().status.tag_size_off.has_value()) << "the twin: not certain yet";
  s.tracker().size->disagrees = true;
  EXPECT_EQ(s.pair().status.tag_size_off, -0.032);
  EXPECT_EQ(s.pair().status.tool, "guide");
  s.says("accept");
  EXPECT_EQ(s.pair().status.tag_size_off, -0.032) << "beside the message";
  EXPECT_EQ(notice_of(s.pair()), Notice::kNotPossibleNow);
}

TEST_F(Guided, TheLossOfTheToolIsSaidBesideAnyMessage) {
  s.says("accept");
  s.tracker().guide.reset();
  EXPECT_TRUE(s.pair().status.tool_lost);
  EXPECT_EQ(notice_of(s.pair()), Notice::kNotPossibleNow);
}

TEST_F(Guided, AMessageGoesAfterThreeSeconds) {
  s.says("accept");
  EXPECT_EQ(notice_of(s.pairs(88)), Notice::kNotPossibleNow);
  EXPECT_EQ(notice_of(s.pairs(3)), Notice::kNone);
}

TEST_F(Guided, RejectingForgetsWhatWasPredicted) {
  EXPECT_FALSE(s.pair().levels[0].predicted.empty());
  EXPECT_TRUE(s.says("reject").levels[0].predicted.empty());
}

TEST(Delete, KeepsASavedRegionUntilDeleteIsSaidTwice) {
  ScriptedOperation s;
  digitizes(s);
  s.strokes(3);
  s.says("delete");
  ASSERT_EQ(s.pairs(1).regions.size(), 1u) << "what was not saved goes at once";
  const auto* confirm = said<ConfirmDelete>(s.says("delete"));
  ASSERT_NE(confirm, nullptr);
  EXPECT_EQ(confirm->points, 5u);
  s.pairs(200);  // more than 5 s, so it no longer counts as said twice
  const Guidance& asked = s.says("delete");
  ASSERT_EQ(asked.regions.size(), 1u);
  EXPECT_EQ(asked.regions[0].samples.size(), 5u);
  const Guidance& gone = s.says("delete");
  EXPECT_EQ(gone.regions.size(), 0u);
  ASSERT_NE(gone.dropped, nullptr) << "it fades";
  EXPECT_EQ(notice_of(s.says("delete")), Notice::kNothingToDelete);
}

TEST(Delete, CostsNothingAfterAPressWithoutSamples) {
  ScriptedOperation s;
  digitizes(s);
  s.tracker().pointer.reset();  // hidden while the button is down
  s.does({kPress, kRelease});
  const Guidance& g = s.says("delete");
  ASSERT_EQ(g.regions.size(), 1u);
  EXPECT_TRUE(g.regions[0].saved);
}

}  // namespace
}  // namespace orthonav::engine::session_safety_test
