#include "study/study_profile.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/phantom/phantom.h"
#include "study/sim_scenario.h"
#include "study/study_definition.h"
#include "study/study_statistics.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json profile_json() {
  return {{"name", "one"},
          {"method", "paper"},
          {"guidance", "numbers"},
          {"instrument", "wire"},
          {"magnitudes", {{"tissue_m", 0.001}}}};
}

Result<StudyProfile> parsed(const json& profile) {
  return parse_profile(profile.dump(), "mine.json");
}

TEST(StudyProfile, OfThePublicationIsThePaperWithAWire) {
  const auto profile = profile_named("liebmann-2019");
  ASSERT_TRUE(profile.ok()) << profile.error().message;
  EXPECT_EQ(profile->method, "paper");
  EXPECT_EQ(profile->magnitudes.wire_bending_rad, sim::ErrorModel().wire_bending_rad);
  EXPECT_TRUE(profile->can_be_previewed());
}

TEST(StudyProfile, TakesItsMagnitudesOverItsInstruments) {
  json profile = profile_json();
  profile["magnitudes"]["wire_bending_rad"] = 0.011;
  const auto read = parsed(profile);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->magnitudes.wire_bending_rad, 0.011);
  EXPECT_EQ(read->magnitudes.tissue_m, 0.001);
}

TEST(StudyProfile, StrokesAsTheMethodIsUsedUnlessItSaysMore) {
  json profile = profile_json();
  EXPECT_FALSE(parsed(profile)->exposure.has_value());
  EXPECT_EQ(strokes_of("best"), sim::Exposure::kLaminae);
  EXPECT_EQ(strokes_of("paper"), sim::Exposure::kTrainedPattern);
  profile["exposure"] = "transverse processes";
  const auto read = parsed(profile);
  ASSERT_TRUE(read.ok()) << read.error().message;
  OperationOptions options;
  read->apply(options);
  EXPECT_EQ(options.exposure, sim::Exposure::kTransverseProcesses);
}

/// Everything that a session is told is off by the factor; the room itself, and so its errors,
/// stay.
TEST(StudyProfile, TellsTheSessionSdsThatAreOffByAFactor) {
  const Case spine = phantom({"L5"});
  StudyOptions right;
  StudyOptions wrong;
  parsed(profile_json())->apply(right.operation);
  json profile = profile_json();
  profile["told_sd_factor"] = 2.0;
  const auto read = parsed(profile);
  ASSERT_TRUE(read.ok()) << read.error().message;
  read->apply(wrong.operation);
  const KnownErrors known = errors_in(right.operation.sim);
  const KnownErrors told = errors_in(wrong.operation.sim);
  EXPECT_GT(known.tip_m->sd, 0.0);
  EXPECT_DOUBLE_EQ(told.tip_m->sd, 2.0 * known.tip_m->sd);
  EXPECT_DOUBLE_EQ(told.cameras_m->sd, 2.0 * known.cameras_m->sd);
  EXPECT_DOUBLE_EQ(told.map_drift_m_per_sqrt_s->sd, 2.0 * known.map_drift_m_per_sqrt_s->sd);
  SessionOptions of_right;
  SessionOptions of_wrong;
  tell_instruments(right.operation.sim, of_right);
  tell_instruments(wrong.operation.sim, of_wrong);
  EXPECT_DOUBLE_EQ(of_wrong.placed.tip_sd_m, 2.0 * of_right.placed.tip_sd_m);
  EXPECT_DOUBLE_EQ(of_wrong.placed.axis_sd_rad, 2.0 * of_right.placed.axis_sd_rad);
  EXPECT_DOUBLE_EQ(of_wrong.astray.direction_rad, 2.0 * of_right.astray.direction_rad);
  EXPECT_EQ(wrong.operation.sim.error_model.tip_calibration_m,
            right.operation.sim.error_model.tip_calibration_m);
  EXPECT_NE(definition_of({&spine, 1}, wrong), definition_of({&spine, 1}, right))
      << "another study, whose results must not be joined with these";
}

// Otherwise the preview would show a different operation from the study's.
TEST(StudyProfile, IsPreviewedWhereThePreviewShowsAllOfIt) {
  const auto shown = [](const char* key, const json& value) {
    json profile = profile_json();
    profile[key] = value;
    const auto read = parsed(profile);
    EXPECT_TRUE(read.ok()) << read.error().message;
    return read.ok() && read->can_be_previewed();
  };
  EXPECT_TRUE(shown("instrument", "cannula"));
  EXPECT_FALSE(shown("navigation", {{"target_mm", 2.0}, {"angle_deg", 1.0}}));
  EXPECT_FALSE(shown("reference", true));
  EXPECT_FALSE(shown("told_sd_factor", 2.0));
  EXPECT_FALSE(shown("without", {"tips"}));
  EXPECT_FALSE(shown("exposure", "transverse processes"));
}

TEST(StudyProfile, AStatedNavigationHoldsWhatTheRoomWouldAdd) {
  json profile = profile_json();
  profile["navigation"] = {{"target_mm", 2.0}, {"angle_deg", 1.0}};
  const auto read = parsed(profile);
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_TRUE(read->navigation.has_value());
  EXPECT_DOUBLE_EQ(read->navigation->target_m, 0.002);
  EXPECT_EQ(read->magnitudes.map_drift_m_per_sqrt_s, 0.0);
  EXPECT_GT(read->magnitudes.wire_bending_rad, 0.0);
}

TEST(StudyProfile, RefusesWhatItDoesNotKnow) {
  const auto refused = [](const char* key, const json& value) {
    json profile = profile_json();
    profile[key] = value;
    const auto read = parsed(profile);
    return read.ok() ? std::string("accepted") : read.error().message;
  };
  EXPECT_THAT(refused("guidance", "by smell"), HasSubstr("mine.json: guidance"));
  EXPECT_THAT(
      refused("exposure", "all of it"),
      HasSubstr("'all of it' is unknown (known: laminae, transverse processes, trained pattern)"));
  EXPECT_THAT(refused("instrument", "spoon"), HasSubstr("'spoon': unknown"));
  EXPECT_THAT(refused("method", "third"), HasSubstr("third"));
  EXPECT_EQ(refused("told_sd_factor", 20),
            "mine.json: told_sd_factor is 20, must lie in [0.1, 10]");
  EXPECT_THAT(refused("magnitudes", {{"tissue_m", 5.0}}), HasSubstr("tissue_m is 5, must lie in"));
  EXPECT_EQ(refused("magnitudes", {{"tissue_m", 0.001}, {"tisue_m", 0.001}}),
            "mine.json: magnitudes.tisue_m is unknown: no magnitude of the simulated room has that "
            "name");
  EXPECT_EQ(profile_named("nobody").error().message,
            "--profile nobody: neither a file nor liebmann-2019");
}

json study_of(const std::vector<std::vector<double>>& angles_of_operations) {
  json runs = json::array();
  for (const auto& angles : angles_of_operations) {
    json screws = json::array();
    for (const double angle : angles) {
      screws.push_back({{"angle_error_deg", angle}});
    }
    runs.push_back({{"levels", {{{"screws", screws}}}}});
  }
  return {{"runs", runs}};
}

TEST(ClusteredMean, TheScrewsOfOneOperationCountOnce) {
  // Two operations whose screws agree: the mean is known no better than two values tell.
  const auto mean = mean_over(study_of({{1, 1, 1, 1}, {3, 3, 3, 3}}), "angle_error_deg", true);
  ASSERT_TRUE(mean.has_value());
  EXPECT_DOUBLE_EQ(mean->mean, 2.0);
  EXPECT_EQ(mean->values, 8u);
  EXPECT_EQ(mean->operations, 2u);
  EXPECT_DOUBLE_EQ(mean->standard_error, 1.0);
  EXPECT_FALSE(mean_over(study_of({{1.0}}), "entry_error_mm", true).has_value());
}

json level_off_by(double error_mm, double sd_mm) {
  const double v = sd_mm * sd_mm;
  const json covariance = {{v, 0, 0}, {0, v, 0}, {0, 0, v}};
  return {{"accepted", true},
          {"errors_mm", {{error_mm, 0, 0}, {0, error_mm, 0}}},
          {"registration",
           {{"screws",
             {{{"entry_covariance_mm2", covariance}, {"target_covariance_mm2", covariance}}}}}}};
}

TEST(RegistrationQuality, CountsWhatLiesInItsEllipsoidAndWhatFailsSilently) {
  const nlohmann::ordered_json runs = {{{"levels", {level_off_by(1.8, 1.0)}}},
                                       {{"levels", {level_off_by(2.5, 1.0)}}},
                                       {{"levels", {level_off_by(0.5, 0.1)}}}};
  RegistrationCounts counts;
  for (const auto& run : runs) {
    add_run(run, counts);
  }
  const RegistrationQuality quality = counts.quality();
  EXPECT_EQ(quality.levels, 3);
  EXPECT_EQ(quality.places, 6);
  EXPECT_NEAR(quality.within_68, 1.0 / 3.0, 1e-12);  // 1.8 of 1.87
  EXPECT_NEAR(quality.within_95, 2.0 / 3.0, 1e-12);  // 2.5 of 2.80
  EXPECT_EQ(quality.silent, 1);
}

TEST(RegistrationQuality, ItsUpperLimitIsExact) {
  EXPECT_NEAR(upper_limit_95(0, 100), 1.0 - std::pow(0.05, 0.01), 1e-9);
  EXPECT_NEAR(upper_limit_95(1, 20), 0.2161, 1e-4);  // tables of Clopper and Pearson
  EXPECT_EQ(upper_limit_95(5, 5), 1.0);
}

}  // namespace
}  // namespace orthonav::engine
