// Drill mode inside step `guide`.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "engine/session/session.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::session_drill_test {
namespace {

using nav::DrillAlarm;
using nav::DrillPhase;
using test::guide_at;
using test::ScriptedOperation;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr double kSd_m = 0.0004;

/// While the left screw of the box is guided: 35 mm long, straight in along -y.
struct Drilling : ScriptedOperation {
  explicit Drilling(const SessionOptions& options = {}) : ScriptedOperation({"L4"}, options) {
    registers_within(kSd_m);
    accepts_first_level();
    says("next");
  }
  nav::DrillView at(double depth_m, double beside_m = 0.0, int pairs_there = 1) {
    tracker().guide = guide_at(kLeftEntry + Vec3{beside_m, -depth_m, 0}, 0.0);
    return pairs(pairs_there).drill;
  }
  nav::DrillView drills_to(double depth_m) {
    at(0.0, 0.0, 20);
    for (double there_m = 0.002; there_m < depth_m; there_m += 0.002) {
      at(there_m);
    }
    return at(depth_m);
  }
};

TEST(SessionDrill, BeginsByItselfAndIsWatchedInEveryPair) {
  Drilling s;
  EXPECT_EQ(s.at(-0.020).phase, DrillPhase::kAway);
  EXPECT_EQ(s.at(0.0, 0.0, 20).phase, DrillPhase::kSet);
  EXPECT_EQ(s.drills_to(0.010), (nav::DrillView{DrillPhase::kDrilling, DrillAlarm::kNone, true}));
  EXPECT_EQ(s.at(0.010, 0.0015).alarm, DrillAlarm::kAmber);
  EXPECT_EQ(s.at(0.010, 0.0025).alarm, DrillAlarm::kRed);
}

TEST(SessionDrill, BeginsByCommandInGuideAlone) {
  Drilling s;
  s.at(0.004, 0.0, 2);
  EXPECT_EQ(s.says("drill").drill.phase, DrillPhase::kDrilling);
  ScriptedOperation early;
  early.accepts_first_level();
  const Guidance& refused = early.says("drill");
  EXPECT_EQ(refused.step, Step::kTouchLandmark);
  EXPECT_EQ(refused.drill, nav::DrillView{});
  ASSERT_NE(refused.status.message, nullptr);
  EXPECT_TRUE(std::holds_alternative<NotPossibleNow>(*refused.status.message));
}

TEST(SessionDrill, StopsShortOfTheTargetAndNeverBehindIt) {
  Drilling s;
  const double length_m = 0.035;
  const double margin_m = std::max(0.001, 1.645 * std::hypot(kSd_m, test::guide_sd_m()));
  double stopped_at_m = 0.0;
  s.drills_to(0.030);
  for (double depth_m = 0.030; depth_m < length_m; depth_m += 0.0002) {
    if (s.at(depth_m).alarm == DrillAlarm::kStop) {
      stopped_at_m = depth_m;
      break;
    }
  }
  EXPECT_GE(stopped_at_m, length_m - margin_m - 0.0001);
  EXPECT_LE(stopped_at_m, length_m - margin_m + 0.0003);
}

TEST(SessionDrill, AStopStaysWhileTheToolIsHiddenAndADeviationGoes) {
  Drilling s;
  s.drills_to(0.010);
  ASSERT_EQ(s.at(0.010, 0.0025).alarm, DrillAlarm::kRed);
  s.tracker().guide_origin = PoseStatus::kPredicted;
  EXPECT_EQ(s.pair().drill, (nav::DrillView{DrillPhase::kDrilling, DrillAlarm::kNone, false}));
  s.tracker().guide_origin = PoseStatus::kMeasured;
  ASSERT_EQ(s.drills_to(0.0345).alarm, DrillAlarm::kStop);
  s.tracker().guide.reset();
  EXPECT_EQ(s.pairs(20).drill, (nav::DrillView{DrillPhase::kDrilling, DrillAlarm::kStop, false}));
  EXPECT_EQ(s.session().expire(s.now()).drill.alarm, DrillAlarm::kStop);
}

TEST(SessionDrill, EndsWithWithdrawalAndWithTheScrew) {
  Drilling s;
  s.drills_to(0.010);
  EXPECT_EQ(s.at(-0.006).phase, DrillPhase::kAway);
  s.drills_to(0.010);
  EXPECT_EQ(s.says("next").drill.phase, DrillPhase::kAway);
}

TEST(SessionDrill, ForgetsWhatLayDeeperBesideTheScrewBeforeTheTipWasSet) {
  Drilling s;
  s.at(0.012, 0.009, 5);  // at the landmark, or past the facet
  s.at(0.0, 0.0005, 30);  // a sleeve is set, and stays there while the drill goes in
  s.says("next");
  const auto& executed = s.session().levels()[0].screws[0].executed;
  ASSERT_TRUE(executed);
  EXPECT_NEAR(executed->depth_m, 0.0, 1e-9);
  EXPECT_NEAR(executed->axis.point.v.x, 0.0155, 1e-9);
}

TEST(SessionDrill, KeepsWhereTheToolWent) {
  Drilling s;
  s.drills_to(0.0300);
  s.at(0.0300, 0.0010, 10);
  s.at(0.0, -0.004, 3);  // drawn back
  EXPECT_FALSE(s.session().levels()[0].screws[0].executed.has_value());
  s.says("next");
  const auto& executed = s.session().levels()[0].screws[0].executed;
  ASSERT_TRUE(executed && executed->point_covariance_m2);
  EXPECT_EQ(executed->pairs, 11u);
  EXPECT_NEAR(executed->axis.point.v.x, 0.015 + 0.0010 * 10 / 11, 1e-9);
  EXPECT_NEAR((executed->axis.direction - Vec3{0, -1, 0}).norm(), 0.0, 1e-9);
  EXPECT_NEAR(std::sqrt((*executed->point_covariance_m2)[8]),
              std::hypot(kSd_m, test::guide_sd_m(), 0.0300 * PlacedWireRules{}.axis_sd_rad), 1e-9);
  EXPECT_FALSE(s.session().levels()[0].screws[1].executed.has_value());
}

}  // namespace
}  // namespace orthonav::engine::session_drill_test
