#include "study/rod_experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/angle.h"

namespace orthonav::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// No errors, and every step takes its mean time.
RodExperimentOptions flawless_bending() {
  RodExperimentOptions o;
  o.head_pick_m = o.navigation_m = o.perception_m = o.length_reading_m = 0.0;
  o.eye_length_sd = o.eye_overbend_rad_per_m = o.eye_bend_sd = o.eye_place_m = 0.0;
  o.recovery_error = o.cutting_m = o.placing_m = 0.0;
  o.socket_seating_m = o.neighbour_navigation_m = o.placing_by_marks_m = 0.0;
  o.pace_sd = o.durations.scatter = 0.0;
  return o;
}

std::vector<double> times_of(const RodArm& arm) {
  std::vector<double> times_s;
  std::transform(arm.rods.begin(), arm.rods.end(), std::back_inserter(times_s),
                 [](const BentRod& rod) { return rod.time_s; });
  return times_s;
}

RodExperiment rods_bent(std::size_t rods, std::uint64_t seed) {
  RodExperimentOptions options;
  options.rods = rods;
  return run_rod_experiment(options, seed);
}

TEST(RodExperiment, SpringsBackAsTheFormulaSays) {
  RodExperimentOptions options;
  EXPECT_NEAR(elastic_recovery_rad(options), 4.71 * kRadiansPerDegree, 0.01 * kRadiansPerDegree);
  options.rod_diameter_m *= 2.0;
  EXPECT_NEAR(elastic_recovery_rad(options), 2.355 * kRadiansPerDegree, 0.005 * kRadiansPerDegree);
}

TEST(RodExperiment, BendsAStraightRodWithoutFlawsToTheExactLengthAndTime) {
  RodExperimentOptions options = flawless_bending();
  options.heads_m = {{0, 0, 0}, {0, 0, 0.03}, {0, 0, 0.07}, {0, 0, 0.11}};
  const RodExperiment experiment = run_rod_experiment(options, 1);
  ASSERT_EQ(experiment.with_template.rods.size(), 18U);
  ASSERT_EQ(experiment.control.rods.size(), 18U);
  // Measured, cut, two bends with a look each, tried once.
  const double work_s = options.pace * (20.0 + 30.0 + 2.0 * (20.0 + 10.0) + 25.0);
  for (const RodArm* arm : {&experiment.with_template, &experiment.control}) {
    for (const BentRod& rod : arm->rods) {
      EXPECT_NEAR(rod.length_m, 0.120, 2e-6);
      EXPECT_NEAR(rod.first_overhang_m, 0.005, 2e-6);
      EXPECT_NEAR(rod.last_overhang_m, 0.005, 2e-6);
      EXPECT_LT(rod.head_distance_m, 1e-9);
      EXPECT_EQ(rod.rebends, 0);
      EXPECT_TRUE(rod.right_length);
    }
  }
  EXPECT_NEAR(experiment.control.mean_time_s, work_s, 1e-9);
  EXPECT_NEAR(experiment.with_template.mean_time_s, work_s + 4.0 * 7.3, 1e-9);
  EXPECT_NEAR(experiment.time_s.low, 4.0 * 7.3, 1e-9);
}

TEST(RodExperiment, BendsEveryLumbarRodWithoutFlawsIntoItsSeats) {
  const RodExperiment experiment = run_rod_experiment(flawless_bending(), 3);
  for (const RodArm* arm : {&experiment.with_template, &experiment.control}) {
    EXPECT_EQ(arm->right_lengths, 18U);
    EXPECT_EQ(arm->rebends, 0U);
  }
  EXPECT_LT(experiment.with_template.mean_head_distance_m, 1e-9);
}

TEST(RodExperiment, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const RodExperiment once = rods_bent(18, 7);
  const RodExperiment again = rods_bent(18, 7);
  const RodExperiment other = rods_bent(18, 8);
  EXPECT_EQ(times_of(once.with_template), times_of(again.with_template));
  EXPECT_EQ(times_of(once.control), times_of(again.control));
  EXPECT_NE(times_of(once.with_template), times_of(other.with_template));
  EXPECT_NE(times_of(once.control), times_of(other.control));
}

TEST(RodExperiment, BendsTheSameRodsFirstHoweverManyThereAre) {
  const auto few = times_of(rods_bent(5, 7).control);
  auto many = times_of(rods_bent(9, 7).control);
  ASSERT_EQ(many.size(), 9U);
  many.resize(5);
  EXPECT_EQ(few, many);
}

TEST(RodExperiment, ControlIsWhatItWasFittedTo) {
  const RodArm control = rods_bent(1000, 1).control;
  ASSERT_EQ(control.rods.size(), 1000U);
  // Three standard errors of 1,000 rods: 3 x 275 s / sqrt(1000), 3 x sqrt(0.22 x 0.78 / 1000).
  EXPECT_NEAR(control.mean_time_s, 465.0, 26.0);
  EXPECT_NEAR(static_cast<double>(control.right_lengths) / 1000.0, 4.0 / 18.0, 0.04);
}

TEST(RodExperiment, TemplateGivesTheRightLengthMoreOftenAndABetterFirstTry) {
  const RodExperiment experiment = rods_bent(300, 2);
  EXPECT_GT(experiment.right_length.low, 0.5);
  EXPECT_LT(experiment.first_try_m.high, 0.0);
  EXPECT_LT(experiment.right_length.low, experiment.right_length.mean);
  EXPECT_LT(experiment.right_length.mean, experiment.right_length.high);
  // If the length by eye is as good as with a ruler, the interval shows no such difference.
  RodExperimentOptions ruler;
  ruler.rods = 300;
  ruler.eye_length_sd = 0.005;
  EXPECT_LT(run_rod_experiment(ruler, 2).right_length.low, 0.05);
}

TEST(RodExperiment, TemplateThroughTheHeadsCutsTooShort) {
  RodExperimentOptions options;
  options.rods = 200;
  const auto right = run_rod_experiment(options, 4).with_template.right_lengths;
  options.assumed_head_to_seat_m = 0.0;
  EXPECT_LT(run_rod_experiment(options, 4).with_template.right_lengths, right);
}

TEST(RodExperiment, HasAnIntervalFromThreeRodsOn) {
  EXPECT_TRUE(std::isnan(rods_bent(2, 1).time_s.low));
  EXPECT_FALSE(std::isnan(rods_bent(3, 1).time_s.low));
}

/// No errors in following instructions either.
RodExperimentOptions flawless_following() {
  RodExperimentOptions o = flawless_bending();
  o.spring_back_error = o.bender_setting_rad = o.roll_setting_rad = 0.0;
  return o;
}

/// The last tolerance of the instructions at a seat, plus the sagitta of the chords that
/// approximate arcs.
constexpr double kPromised_m = 0.5e-3 + 0.03e-3;

/// The mean time of a rod bent as instructed, without scatter.
double time_of_steps_s(const RodExperimentOptions& options, const InstructedRod& rod) {
  const bool long_rod = rod.rod.heads >= options.long_rod_heads;
  const auto heads = static_cast<double>(rod.rod.heads);
  const auto bends = static_cast<double>(rod.bends.value());
  return heads * (long_rod ? 7.3 + 3.0 : 7.3) +
         options.pace * (20.0 + 30.0 + 5.0 + bends * (5.0 + 20.0) + 25.0);
}

TEST(InstructedRods, ReachEveryHeadWithoutFlawsInTheTimeOfTheirSteps) {
  const RodExperimentOptions options = flawless_following();
  const InstructedRods found = run_instructed_rods(options, 3);
  ASSERT_EQ(found.rods.size(), 18U);
  EXPECT_EQ(found.arm.right_lengths, 18U);
  for (const InstructedRod& rod : found.rods) {
    if (!rod.bends) {
      continue;
    }
    EXPECT_LE(rod.off_touched_m, kPromised_m);
    EXPECT_LE(rod.off_heads_m, kPromised_m);
    EXPECT_NEAR(rod.rod.time_s, time_of_steps_s(options, rod), 1e-9);
  }
  EXPECT_LE(found.refused, 1U);
}

InstructedRods bent_with(const RodExperimentOptions& options) {
  return run_instructed_rods(options, 11);
}

/// Each of the parts that bring a rod to the true heads, left out.
TEST(InstructedRods, LieInTheTrueHeadsBecauseOfEachPart) {
  RodExperimentOptions options;
  options.rods = 40;
  const InstructedRods designed = bent_with(options);
  EXPECT_GE(designed.within_of_heads, 34U);
  EXPECT_EQ(designed.arm.right_lengths, 40U);
  EXPECT_NEAR(designed.expected_within, 0.95, 0.05) << "and that was said before";

  RodExperimentOptions on_top = options;
  on_top.in_socket = false;
  EXPECT_LT(bent_with(on_top).within_of_heads, designed.within_of_heads / 2);
  RodExperimentOptions unsure = options;
  unsure.socket_seating_m = 0.0008;
  const InstructedRods once = bent_with(unsure);
  unsure.head_touches = unsure.long_rod_touches = 8;
  EXPECT_GT(bent_with(unsure).within_of_heads, once.within_of_heads) << "touched again";
  RodExperimentOptions unmarked = options;
  unmarked.placing_m = 0.002;
  unmarked.ends_marked = false;
  EXPECT_LT(bent_with(unmarked).arm.right_lengths, 40U);
}

TEST(InstructedRods, TouchesDoNotChangeTheOtherArms) {
  RodExperimentOptions options;
  const RodExperiment before = run_rod_experiment(options, 7);
  options.in_socket = false;
  options.socket_seating_m = options.neighbour_navigation_m = 0.002;
  options.head_touches = options.long_rod_touches = 9;
  options.ends_marked = false;
  const RodExperiment after = run_rod_experiment(options, 7);
  EXPECT_EQ(times_of(before.with_template), times_of(after.with_template));
  EXPECT_EQ(times_of(before.control), times_of(after.control));
  EXPECT_EQ(before.with_template.right_lengths, after.with_template.right_lengths);
}

TEST(InstructedRods, AreBentWithTheTemplateWhereThereAreNoInstructions) {
  RodExperimentOptions options;
  options.in_socket = false;     // the same touches as with the template
  options.bend_width_m = 0.045;  // longer than what the heads leave free
  const InstructedRods found = run_instructed_rods(options, 7);
  EXPECT_EQ(found.refused, 18U);
  EXPECT_EQ(times_of(found.arm), times_of(run_rod_experiment(options, 7).with_template));
}

TEST(InstructedRods, AreTheSameForTheSameSeed) {
  RodExperimentOptions options;
  options.rods = 4;
  const auto once = times_of(run_instructed_rods(options, 7).arm);
  EXPECT_EQ(once, times_of(run_instructed_rods(options, 7).arm));
  EXPECT_NE(once, times_of(run_instructed_rods(options, 8).arm));
}

TEST(RodExperimentOptions, SaysEverythingThatIsWrong) {
  RodExperimentOptions options;
  EXPECT_THAT(options.check(), ElementsAre());
  options.rods = 0;
  options.pace = std::numeric_limits<double>::quiet_NaN();
  options.to_bone = {};
  EXPECT_THAT(options.check(), ElementsAre("rods is 0, limit 1-100000", HasSubstr("pace is"),
                                           "to_bone is zero or not finite"));
  options = {};
  options.to_bone = {0, 0, 1};
  EXPECT_THAT(options.check(), ElementsAre(HasSubstr("along the built-in spine")));
  options.heads_m = {{0, 0, 0}, {0, 0, 0.04}};
  EXPECT_THAT(options.check(), ElementsAre("to_bone: the rod runs along it"));
  options.to_bone = {0, -1, 0};
  EXPECT_THAT(options.check(), ElementsAre());
  options.heads_m[1].z = 0.014;
  EXPECT_THAT(options.check(), ElementsAre(HasSubstr("14.0 mm apart, at least 15 mm")));
  options.heads_m.resize(1);
  EXPECT_THAT(options.check(), ElementsAre(HasSubstr("at least 2 screw heads")));
}

}  // namespace
}  // namespace orthonav::engine
