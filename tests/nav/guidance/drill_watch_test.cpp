#include "nav/guidance/drill_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace orthonav::nav::drill_watch_test {
namespace {

constexpr double kDegree = 3.14159265358979 / 180.0;
constexpr double kTarget_m = 0.040;

/// A drill moving straight into the bone, at 30 pairs a second.
struct Drilled {
  DrillWatch watch;
  DrillReading reading{.depth_sd_m = 0.0004};
  Timestamp now{};

  DrillView at(double depth_m, double off_axis_m = 0.0, double angle_rad = 0.0) {
    now += std::chrono::milliseconds(33);
    reading.time = now;
    reading.depth_m = depth_m;
    reading.tip_m = {off_axis_m, -depth_m, 0};
    reading.from_bone_m = std::abs(depth_m);
    reading.off_axis_m = off_axis_m;
    reading.angle_rad = angle_rad;
    reading.to_target_m = kTarget_m - depth_m;
    watch.measured(reading);
    return watch.view();
  }
  DrillView rests(double depth_m, int pairs, double off_axis_m = 0.0) {
    for (int i = 0; i < pairs; ++i) {
      at(depth_m, off_axis_m);
    }
    return watch.view();
  }
  /// Drills from the entry to a depth, one millimetre per pair.
  DrillView drills_to(double depth_m) {
    rests(0.0, 20);
    for (double there_m = 0.001; there_m < depth_m; there_m += 0.001) {
      at(there_m);
    }
    return at(depth_m);
  }
};

TEST(DrillWatch, BeginsByItselfWhereATipThatRestedAdvances) {
  Drilled d;
  EXPECT_EQ(d.at(-0.020).phase, DrillPhase::kAway);
  EXPECT_EQ(d.rests(0.0, 10).phase, DrillPhase::kAway) << "a third of a second";
  EXPECT_EQ(d.rests(0.0, 10).phase, DrillPhase::kSet);
  EXPECT_EQ(d.at(0.0019).phase, DrillPhase::kSet);
  EXPECT_EQ(d.at(0.0021).phase, DrillPhase::kDrilling);
}

TEST(DrillWatch, KnowsWhereTheDepthStopComes) {
  Drilled d;
  EXPECT_FALSE(d.at(-0.020).stop_past_target_m) << "there is none";
  d.reading.stop_m = 0.044;
  EXPECT_NEAR(*d.at(-0.020).stop_past_target_m, 0.004, 1e-12) << "as if set on the entry";
  d.rests(0.001, 20);
  ASSERT_EQ(d.watch.view().phase, DrillPhase::kSet);
  EXPECT_NEAR(*d.watch.view().stop_past_target_m, 0.005, 1e-12) << "from where it was set";
  EXPECT_NEAR(*d.at(0.010).stop_past_target_m, 0.005, 1e-12) << "however deep it is now";
  d.watch.not_measured();
  EXPECT_NEAR(*d.watch.view().stop_past_target_m, 0.005, 1e-12);
  d.watch.forget();
  EXPECT_FALSE(d.watch.view().stop_past_target_m) << "another screw";
  d.reading.stop_m = 0.035;
  EXPECT_NEAR(*d.at(-0.020).stop_past_target_m, -0.005, 1e-12) << "short of it";
}

TEST(DrillWatch, TakesNoPassingTipForOneThatIsSet) {
  Drilled moving;
  for (int i = 0; i < 60; ++i) {
    // Slides over the bone by 4 mm a second.
    EXPECT_EQ(moving.at(0.0, 0.0049 - 0.00016 * (i % 30)).phase, DrillPhase::kAway) << i;
    moving.reading.tip_m.x += i % 30 == 29 ? 0.01 : 0.0;
  }
  Drilled above;
  EXPECT_EQ(above.rests(-0.0021, 60).phase, DrillPhase::kAway) << "over the bone";
  Drilled aside;
  EXPECT_EQ(aside.rests(0.0, 60, 0.0051).phase, DrillPhase::kAway) << "beside the axis";
}

TEST(DrillWatch, CountsNoRestThatNobodySaw) {
  Drilled d;
  d.rests(0.0, 10);
  d.now += std::chrono::milliseconds(500);
  EXPECT_EQ(d.at(0.0).phase, DrillPhase::kAway);
  EXPECT_EQ(d.rests(0.0, 16).phase, DrillPhase::kSet);
}

TEST(DrillWatch, BeginsByCommandAnywhereInTheBone) {
  Drilled d;
  d.at(0.010);
  EXPECT_EQ(d.watch.view().phase, DrillPhase::kAway);
  d.watch.begin();
  EXPECT_EQ(d.at(0.010).phase, DrillPhase::kDrilling);
  Drilled away;
  away.watch.begin();
  EXPECT_EQ(away.at(-0.030).phase, DrillPhase::kAway) << "the tip is not at the entry";
}

TEST(DrillWatch, ForgetsATipThatIsLiftedOffBeforeItDrills) {
  Drilled d;
  ASSERT_EQ(d.rests(0.0, 20).phase, DrillPhase::kSet);
  EXPECT_EQ(d.at(-0.0049).phase, DrillPhase::kSet);
  EXPECT_EQ(d.at(-0.0051).phase, DrillPhase::kAway);
  ASSERT_EQ(d.rests(0.0, 20).phase, DrillPhase::kSet);
  EXPECT_EQ(d.at(0.0, 0.0051).phase, DrillPhase::kAway);
}

TEST(DrillWatch, EndsWhereTheDrillIsWithdrawn) {
  Drilled d;
  ASSERT_EQ(d.drills_to(0.020).phase, DrillPhase::kDrilling);
  EXPECT_EQ(d.at(-0.0049).phase, DrillPhase::kDrilling);
  EXPECT_EQ(d.at(-0.0051), (DrillView{DrillPhase::kAway, DrillAlarm::kNone, true}));
}

TEST(DrillWatch, IsAmberAndRedFromTheirLimitsOn) {
  Drilled d;
  d.drills_to(0.010);
  EXPECT_EQ(d.at(0.010, kAmberOffset_m, kAmberAngle_rad).alarm, DrillAlarm::kNone);
  EXPECT_EQ(d.at(0.010, 0.0011).alarm, DrillAlarm::kAmber);
  EXPECT_EQ(d.at(0.010, 0.0, 2.1 * kDegree).alarm, DrillAlarm::kAmber);
  EXPECT_EQ(d.at(0.010, kRedOffset_m, kRedAngle_rad).alarm, DrillAlarm::kAmber);
  EXPECT_EQ(d.at(0.010, 0.0021).alarm, DrillAlarm::kRed);
  EXPECT_EQ(d.at(0.010, 0.0, 4.1 * kDegree).alarm, DrillAlarm::kRed);
  EXPECT_EQ(d.at(0.010).alarm, DrillAlarm::kNone) << "and back";
  EXPECT_EQ(d.at(0.010, std::nan("")).alarm, DrillAlarm::kRed) << "what is not a number is no good";
}

TEST(DrillWatch, AlarmsOnlyWhileItDrills) {
  Drilled d;
  EXPECT_EQ(d.rests(0.0, 20, 0.004).alarm, DrillAlarm::kNone) << "the tip is still being placed";
}

TEST(DrillWatch, StopsBeforeTheTargetByWhatTheDepthIsUnsure) {
  for (const double sd_m : {0.0001, 0.0008, 0.0016}) {
    Drilled d;
    d.reading.depth_sd_m = sd_m;
    const double margin_m = std::max(0.001, 1.645 * sd_m);
    EXPECT_DOUBLE_EQ(d.watch.stop_margin_m(sd_m), margin_m);
    EXPECT_EQ(d.drills_to(kTarget_m - margin_m - 0.0001).alarm, DrillAlarm::kNone) << sd_m;
    EXPECT_EQ(d.at(kTarget_m - margin_m + 0.0001).alarm, DrillAlarm::kStop) << sd_m;
  }
  Drilled unknown;
  unknown.reading.depth_sd_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(unknown.drills_to(kTarget_m - 0.0051).alarm, DrillAlarm::kNone);
  EXPECT_EQ(unknown.at(kTarget_m - 0.0049).alarm, DrillAlarm::kStop);
}

TEST(DrillWatch, StopIsMoreUrgentThanDeviationAndStaysUntilWithdrawn) {
  Drilled d;
  d.drills_to(kTarget_m - 0.0005);
  EXPECT_EQ(d.at(kTarget_m - 0.0005, 0.005).alarm, DrillAlarm::kStop);
  d.watch.not_measured();
  EXPECT_EQ(d.watch.view(), (DrillView{DrillPhase::kDrilling, DrillAlarm::kStop, false}))
      << "nobody knows how deep a hidden tip is";
  EXPECT_EQ(d.at(kTarget_m - 0.0029).alarm, DrillAlarm::kStop) << "not flickering";
  EXPECT_EQ(d.at(kTarget_m - 0.0031).alarm, DrillAlarm::kNone);
}

TEST(DrillWatch, ADeviationGoesWithItsMeasurement) {
  Drilled d;
  d.drills_to(0.010);
  ASSERT_EQ(d.at(0.010, 0.003), (DrillView{DrillPhase::kDrilling, DrillAlarm::kRed, true}));
  d.watch.not_measured();
  EXPECT_EQ(d.watch.view(), (DrillView{DrillPhase::kDrilling, DrillAlarm::kNone, false}));
  EXPECT_EQ(d.at(0.010, 0.003).alarm, DrillAlarm::kRed);
}

TEST(DrillWatch, ForgetsWithTheScrew) {
  Drilled d;
  d.drills_to(kTarget_m);
  d.watch.forget();
  EXPECT_EQ(d.watch.view(), DrillView{});
  EXPECT_EQ(d.at(0.020).phase, DrillPhase::kAway);
}

}  // namespace
}  // namespace orthonav::nav::drill_watch_test
