#include <gtest/gtest.h>

#include "engine/session/session.h"
#include "tests/support/allocation_count.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_allocations_test {
namespace {

using test::guide_at;
using test::pointer_at;
using test::said;
using test::ScriptedOperation;
using test::state;
using test::step_of;
using enum ClickerAction;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
// On the box's posterior face (y = 20 mm), more than 15 mm apart and not on a line.
constexpr Vec3 kFirst{-0.015, 0.020, -0.010};
constexpr Vec3 kSecond{0.015, 0.020, -0.010};
constexpr Vec3 kThird{0.000, 0.020, 0.012};
/// Longer than a message and the echo of a phrase stay, at 30 pairs a second.
constexpr int kWarm = 100;
constexpr int kCounted = 100;

/// Allocations of pairs alone, without phrases or clicks.
std::size_t allocations_of(ScriptedOperation& s, int pairs) {
  const std::size_t before = test::allocation_count();
  s.pairs(pairs);
  return test::allocation_count() - before;
}

/// Allocations in the present state of the operation, once buffers have grown.
std::size_t allocations_once_warm(ScriptedOperation& s) {
  s.pairs(kWarm);
  return allocations_of(s, kCounted);
}

/// Allocations of pairs in which the tool in use comes and goes, and the status line changes.
std::size_t allocations_while_a_tool_comes_and_goes(ScriptedOperation& s,
                                                    std::optional<Transform<World, Marker>>& tool) {
  const auto seen = tool;
  const auto comes_and_goes = [&] {
    tool.reset();
    s.pairs(10);
    tool = seen;
    s.pairs(10);
  };
  comes_and_goes();
  const std::size_t before = test::allocation_count();
  comes_and_goes();
  return test::allocation_count() - before;
}

TEST(SessionAllocations, AreNoneInSetup) {
  ScriptedOperation s;
  EXPECT_EQ(s.pair().step, Step::kSetup);
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, AreNoneWhileDigitizing) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at(kFirst);
  s.says("start");
  EXPECT_EQ(allocations_once_warm(s), 0u) << "with nothing stroked";
  s.strokes(40);
  s.says("save");
  s.strokes(40);
  EXPECT_EQ(state<StrokesSoFar>(s.pair())->points, 80u);
  EXPECT_EQ(allocations_once_warm(s), 0u);
  EXPECT_EQ(allocations_while_a_tool_comes_and_goes(s, s.tracker().pointer), 0u);
}

TEST(SessionAllocations, AreNoneWhileSamplesAreRecorded) {
  ScriptedOperation s;
  s.tracker().pointer = pointer_at(kFirst);
  s.says("start");
  s.does({kPress});
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, AreNoneWhileCoachingTellsWhatToStroke) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch, true);
  s.registration.accepted = false;
  s.registration.stroke_next = nav::BonePlace{nav::BonePlace::Part::kLamina, Side::kLeft, {}};
  s.tracker().pointer = pointer_at(kFirst);
  s.says("start");
  s.strokes(static_cast<int>(Coach::kFewestSamples));
  s.pairs(Coach::kPairsToAnswer);
  ASSERT_NE(state<StrokesSoFar>(s.pair())->coaching, nullptr);
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, AreNoneWhileVerifyingByTouch) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registers_first_level();
  EXPECT_EQ(allocations_once_warm(s), 0u) << "with nothing touched";
  for (const Vec3 place : {kFirst, kSecond, kThird}) {
    s.touches(place);
    EXPECT_EQ(allocations_once_warm(s), 0u);
  }
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kPassed);
  EXPECT_EQ(allocations_while_a_tool_comes_and_goes(s, s.tracker().pointer), 0u);
}

TEST(SessionAllocations, AreNoneWhileACheckPointIsTooFarOff) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registers_first_level();
  s.touches(kFirst + Vec3{0, 0.004, 0});
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kReject);
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, AreNoneWhileThePointerTouches) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registers_first_level();
  s.tracker().pointer = pointer_at(kFirst);
  s.pairs(kWarm);
  s.does({kPress});
  EXPECT_EQ(allocations_of(s, 15), 0u) << "half a second, then the button counts as held";
}

TEST(SessionAllocations, AreNoneWhileTheLandmarkIsTouchedAndAfterItMoved) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.accepts_first_by_touch();
  EXPECT_EQ(allocations_once_warm(s), 0u) << "with nothing touched";
  s.touches_landmark();
  EXPECT_EQ(allocations_once_warm(s), 0u);
  s.says("next");
  s.says("next");
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark);
  EXPECT_EQ(allocations_while_a_tool_comes_and_goes(s, s.tracker().pointer), 0u);
  EXPECT_EQ(s.touches_landmark(Vec3{0, 0, 0.003}).step, Step::kVerify);
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, AreNoneWhileAWireIsMeasuredAndWaitsForAWord) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.registers_within(0.0003);
  s.accepts_first_by_touch();
  s.touches_landmark();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry, 0.1);
  EXPECT_EQ(s.says("next").step, Step::kMeasureWire);
  EXPECT_EQ(allocations_once_warm(s), 0u) << "with nothing measured";
  s.does({kPress});
  EXPECT_EQ(allocations_of(s, 15), 0u) << "while the sleeve is pressed";
  s.does({kRelease, kClick});
  EXPECT_EQ(checks_asked(s.pair().status), ChecksAsked::kDecideOnWire);
  EXPECT_EQ(allocations_once_warm(s), 0u);
  EXPECT_EQ(allocations_while_a_tool_comes_and_goes(s, s.tracker().guide), 0u);
}

TEST(SessionAllocations, AreNoneWhileVerifyingByEyeAndOnceAccepted) {
  ScriptedOperation s;
  s.registers_first_level();
  EXPECT_EQ(s.pair().step, Step::kVerify);
  EXPECT_EQ(allocations_once_warm(s), 0u);
  EXPECT_EQ(s.accepts().step, Step::kTouchLandmark);
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, AreNoneWhileGuiding) {
  ScriptedOperation s;
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry, 0.1);
  EXPECT_TRUE(s.pairs(2).tool.has_value());
  EXPECT_EQ(allocations_once_warm(s), 0u);
  s.says("twin");
  s.tracker().guide_origin = PoseStatus::kPredicted;
  EXPECT_EQ(allocations_of(s, kCounted), 0u) << "on poses that are predicted";
  s.tracker().guide_origin = PoseStatus::kMeasured;
  EXPECT_EQ(allocations_while_a_tool_comes_and_goes(s, s.tracker().guide), 0u);
}

TEST(SessionAllocations, AreNoneWhileATagOfTheWrongSizeIsWarnedOf) {
  ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
  s.tracker().size = nav::TagSize{.fraction = 0.03, .disagrees = true};
  s.registers_first_level();
  EXPECT_EQ(s.pairs(kWarm).status.tag_size_off, 0.03);
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, AreNoneWhileHeadsAreTouchedAndOnceAllIsDone) {
  ScriptedOperation s;
  s.finishes_every_screw();
  EXPECT_EQ(step_of(s.pair()), "rod left");
  EXPECT_EQ(allocations_once_warm(s), 0u) << "with no head touched";
  s.touches({0, 0.02, 0});
  s.touches({0, 0.02, 0.03});
  EXPECT_EQ(state<HeadsSoFar>(s.pair())->count, 2u);
  EXPECT_EQ(allocations_once_warm(s), 0u);
  EXPECT_EQ(allocations_while_a_tool_comes_and_goes(s, s.tracker().pointer), 0u);
  s.says("done");
  EXPECT_EQ(s.says("done").step, Step::kDone);
  EXPECT_EQ(allocations_once_warm(s), 0u);
}

TEST(SessionAllocations, OfAWordAreCounted) {
  ScriptedOperation s;
  s.pairs(kWarm);
  const std::size_t before = test::allocation_count();
  s.says("start");
  EXPECT_GT(test::allocation_count(), before) << "the twin: the counter counts";
}

}  // namespace
}  // namespace orthonav::engine::session_allocations_test
