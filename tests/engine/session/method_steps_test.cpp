#include "engine/session/workflow/workflow.h"

#include <gmock/gmock.h>

#include "engine/session/session.h"
#include "engine/session/text/wording.h"
#include "tests/support/said.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::method_steps_test {
namespace {

using test::guide_at;
using test::said;
using test::ScriptedOperation;
using test::step_of;
using enum ClickerAction;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr double kRegistration_m = 0.0003;

SessionOptions without(bool MethodSteps::*step) {
  SessionOptions options;
  options.steps.*step = false;
  return options;
}

/// An operation in `landmark`, on the first of two levels.
class Accepted : public ScriptedOperation {
 public:
  explicit Accepted(const SessionOptions& options)
      : ScriptedOperation({"L4", "L5"}, options, Verification::kByTouch) {
    registers_within(kRegistration_m);
    if (options.steps.check_points) {
      accepts_first_by_touch();
    } else {
      accepts_first_level();
    }
  }
  const Guidance& drills() {
    touches_landmark();
    says("next");
    tracker().guide = guide_at(kLeftEntry, 0.0);
    pairs(3);
    return says("next");
  }
  const Guidance& measures(double beside_m) {
    tracker().guide = guide_at(kLeftEntry + Vec3{beside_m, 0.004, 0.0}, 0.0);
    does({kPress});
    pair();
    return does({kRelease, kClick});
  }
};

TEST(MethodSteps, AllOfThemAreTakenUntilOneIsLeftOut) {
  Accepted s({});
  EXPECT_EQ(step_of(s.pair()), "landmark L4");
  EXPECT_EQ(step_of(s.drills()), "measure L4 left");
  EXPECT_EQ(step_of(s.says("next")), "landmark L4");
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark) << "the landmark first";
}

TEST(MethodSteps, WithoutCheckPointsALookIsEnough) {
  Accepted s(without(&MethodSteps::check_points));
  EXPECT_EQ(step_of(s.pair()), "landmark L4");
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark) << "the landmark is still asked for";
  EXPECT_EQ(step_of(s.drills()), "measure L4 left");
}

TEST(MethodSteps, WithoutTheLandmarkTheNextScrewComesAtOnce) {
  Accepted s(without(&MethodSteps::landmark));
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark) << "once, for the tips";
  EXPECT_EQ(step_of(s.drills()), "measure L4 left");
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
}

TEST(MethodSteps, WithoutTheLandmarkAScrewIsRedoneAtOnce) {
  Accepted s(without(&MethodSteps::landmark));
  s.drills();
  s.measures(0.0025);
  EXPECT_EQ(step_of(s.says("delete")), "guide L4 left");
}

TEST(MethodSteps, WithoutLandmarkAndTipsNothingIsTouchedBeforeTheScrew) {
  SessionOptions options = without(&MethodSteps::landmark);
  options.steps.tips = false;
  Accepted s(options);
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left");
}

TEST(MethodSteps, WithoutTheWireTheLandmarkFollowsTheScrew) {
  Accepted s(without(&MethodSteps::wire));
  EXPECT_EQ(step_of(s.drills()), "landmark L4");
  EXPECT_FALSE(s.session().levels()[0].screws[0].wire.asked);
  EXPECT_EQ(s.says("next").step, Step::kTouchLandmark);
  s.touches_landmark();
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
}

TEST(MethodSteps, WithoutRedoAWireIsOnlyKept) {
  Accepted s(without(&MethodSteps::redo));
  s.drills();
  s.measures(0.0025);
  const Guidance& g = s.says("delete");
  EXPECT_EQ(step_of(g), "measure L4 left");
  EXPECT_NE(said<NoOtherEntry>(g), nullptr);
  EXPECT_EQ(checks_asked(s.pairs(120).status), ChecksAsked::kKeepWire);
  Accepted twin({});
  twin.drills();
  twin.measures(0.0025);
  EXPECT_EQ(step_of(twin.says("delete")), "landmark L4") << "the twin";
}

TEST(MethodSteps, WithoutTheTipsNobodyAsksForThem) {
  for (const bool tips : {true, false}) {
    SessionOptions options;
    options.steps.tips = tips;
    Accepted s(options);
    s.touches_landmark();
    EXPECT_EQ(checks_asked(s.pair().status) == ChecksAsked::kGuideTip, tips);
  }
}

TEST(MethodSteps, TheEyeAloneTakesNone) {
  ScriptedOperation s({"L4"});
  s.accepts_first_level();
  EXPECT_EQ(step_of(s.says("next")), "guide L4 left");
  EXPECT_EQ(step_of(s.says("next")), "guide L4 right");
}

}  // namespace
}  // namespace orthonav::engine::method_steps_test
