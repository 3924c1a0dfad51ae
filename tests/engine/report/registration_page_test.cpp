#include "engine/report/registration_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/report/registration_scene.h"
#include "tests/engine/report/exact_registration.h"

namespace orthonav::engine {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(RegistrationScene, MeasuresPointsAgainstTheBoneAndFindsTheOneOffIt) {
  const RegistrationScene scene = registration_scene(exact());
  ASSERT_EQ(scene.points.size(), exact().points.size());
  EXPECT_EQ(scene.off_bone, 1U);
  EXPECT_TRUE(scene.points.back().off_bone);
  EXPECT_NEAR(scene.points.back().residual_m, 0.008, 1e-9) << "outside: positive";
  EXPECT_NEAR(scene.points.front().residual_m, 0.0, 1e-9);
  EXPECT_EQ(scene.magnified, 5.0) << "0.37 mm RMS: 95 % within 1.05 mm, drawn below 6 mm";
}

TEST(RegistrationScene, CountsABallsRadiusAndTheInsideAsNegative) {
  RegisteredLevel level = exact();
  level.tip_radius_m = 0.001;
  EXPECT_NEAR(registration_scene(level).points.front().residual_m, -0.001, 1e-9);
}

TEST(RegistrationScene, TakesTheMeanHeightOfTheTipOff) {
  RegisteredLevel level = exact();
  level.registration.standoff_m = 0.0005;
  EXPECT_NEAR(registration_scene(level).points.back().residual_m, 0.0075, 1e-9);
}

TEST(RegistrationPage, ShowsWhatWasTouchedToVerify) {
  RegisteredLevel level = exact();
  EXPECT_THAT(registration_section(level).value(), Not(HasSubstr("class=\"check\"")));
  level.check_points.push_back({level.points[0], 0.0004, true});
  level.check_points.push_back({level.points[9], -0.0025, false});
  const std::string page = registration_section(level).value();
  EXPECT_THAT(page, AllOf(HasSubstr("class=\"check\""), HasSubstr("touched to verify it"),
                          HasSubstr("<td class=bad>2, worst 2.5 ✗ <b>over the limit</b></td>")));
}

/// The table's row that begins with these words.
std::string row_of(const std::string& page, const std::string& name) {
  const std::size_t begin = page.find("<tr><th scope=row>" + name);
  return begin == std::string::npos ? "" : page.substr(begin, page.find("</tr>", begin) - begin);
}

TEST(RegistrationPage, MarksEveryFigureThatFailsInWordsAndNoneAsGood) {
  RegisteredLevel level = exact();
  nav::Registration& r = level.registration;
  r.accepted = false;
  r.inlier_fraction = 0.5;
  r.noise_m = 1.2 * nav::registration_limits().noise_m;
  r.shaft_collision_fraction = 0.4;
  r.log_likelihood_ratio = 3.0;
  std::array<double, 36> covariance{};
  covariance[0] = covariance[7] = covariance[14] = 1.222e-3 * 1.222e-3;
  r.uncertainty = nav::PoseUncertainty{{}, covariance};
  r.tre_99_m = 0.00411;
  r.mirror_log_likelihood = 7.0;
  const std::string page = registration_section(level).value();
  for (const char* name : {"Points on the bone", "Margin of"}) {
    EXPECT_THAT(row_of(page, name), HasSubstr("✗ <b>below the limit</b>")) << name;
  }
  for (const char* name :
       {"Scatter", "Pointer through", "99 % of errors", "Margin of the mirror"}) {
    EXPECT_THAT(row_of(page, name), HasSubstr("✗ <b>over the limit</b>")) << name;
  }
  EXPECT_THAT(row_of(page, "99 % of errors"), HasSubstr("4.11 ✗"));
  EXPECT_THAT(row_of(page, "left target"), HasSubstr("<td>2.12</td>"));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("class=ours")), Not(HasSubstr("class=good"))));
}

TEST(RegistrationPage, SaysHowManyCheckPointsAndTheWorst) {
  RegisteredLevel level = exact();
  level.check_points = {{{}, 0.0004, true}, {{}, -0.0013, true}, {{}, 0.0009, true}};
  EXPECT_THAT(row_of(registration_section(level).value(), "Check points"),
              HasSubstr("3, worst 1.3 ✓"));
  level.check_points.push_back({{}, 0.0031, false});
  EXPECT_THAT(row_of(registration_section(level).value(), "Check points"),
              HasSubstr("4, worst 3.1 ✗"));
}

TEST(RegistrationPage, DrawsTheTissueAndWhereToPress) {
  RegisteredLevel level = exact();
  EXPECT_THAT(registration_section(level).value(), Not(HasSubstr("soft tissue, from behind")));
  nav::Registration& r = level.registration;
  r.accepted = false;
  r.field_sd_m = 0.0008;
  r.stroke_next = nav::BonePlace{};
  r.stroke_next_at = {level.model->reachable().vertices_m.front()};
  const RegistrationScene scene = registration_scene(level);
  // The points lie on the bone, all but one.
  std::size_t known = 0;
  for (const double tissue_m : scene.tissue_m) {
    if (!std::isnan(tissue_m)) {
      ++known;
      EXPECT_NEAR(tissue_m, 0.0, 2e-4);
    }
  }
  EXPECT_GT(known, scene.tissue_m.size() / 2);
  const std::string page = registration_section(level).value();
  EXPECT_THAT(page, AllOf(HasSubstr("soft tissue, from behind"), HasSubstr("press here")));
  r.accepted = true;
  EXPECT_THAT(registration_section(level).value(), Not(HasSubstr("press here")));
}

TEST(RegistrationPage, SaysWhatAllStrokesShareBesideTheLimit) {
  RegisteredLevel level = exact();
  level.registration.predicted_tre_m = 0.0004;
  EXPECT_THAT(registration_section(level).value(), HasSubstr("Of the registration alone"));
  level.registration.common = {0.0005, 0.0003, 0.0012};
  level.registration.uncertainty = with_common(translation_only(), level.registration.common);
  const std::string page = registration_section(level).value();
  EXPECT_THAT(row_of(page, "Error at the worst"), HasSubstr("<td>0.40</td>"));
  EXPECT_THAT(row_of(page, "With what all strokes share"), HasSubstr("2.34"));
  const std::string sources = "With what all strokes share, SD along an axis: ";
  const std::size_t once = page.find(sources + "tip 0.50, cameras 0.30, drift of the map 1.20 mm.");
  ASSERT_NE(once, std::string::npos);
  EXPECT_EQ(page.find(sources, once + 1), std::string::npos) << "said once";
  level.registration.common.map_m = 0.0;
  EXPECT_THAT(registration_section(level).value(),
              HasSubstr(sources + "tip 0.50, cameras 0.30 mm."));
}

TEST(RegistrationPage, PraisesNoErrorOfAPoseThatIsRefused) {
  RegisteredLevel level = exact();
  level.registration.accepted = true;
  EXPECT_THAT(registration_section(level).value(), HasSubstr("errors to expect"));
  level.registration.accepted = false;
  EXPECT_THAT(registration_section(level).value(),
              AllOf(HasSubstr("errors, were this pose right"), Not(HasSubstr("errors to expect"))));
}

TEST(RegistrationPage, TellsAFigureFromTheLimitThatItBreaks) {
  RegisteredLevel level = exact();
  level.registration.tre_99_m = 0.002004;
  EXPECT_THAT(row_of(registration_section(level).value(), "99 % of errors"), HasSubstr("2.004 ✗"));
  level.registration.tre_99_m = 0.0014;
  EXPECT_THAT(row_of(registration_section(level).value(), "99 % of errors"),
              HasSubstr("<td class=good>1.40 ✓</td>"));
  EXPECT_THAT(row_of(registration_section(level).value(), "RMSE"), HasSubstr("<td>0.00</td>"))
      << "without a limit there is nothing to keep";
}

TEST(RegistrationScene, IsThinnedOutWhereThereAreTooManyPoints) {
  RegisteredLevel level = exact();
  while (level.points.size() < 50000) {
    level.points.insert(level.points.end(), level.points.begin(), level.points.end());
  }
  EXPECT_LE(registration_scene(level).points.size(), 4000U);
  EXPECT_THAT(registration_section(level).value(), HasSubstr("Drawn: "));
}

TEST(RegistrationPage, EscapesWhatItIsTold) {
  RegisteredLevel level = exact();
  level.label = "<b>L4";
  level.registration.accepted = false;
  level.registration.reasons = {{nav::RefusalReason::Kind::kFitsOtherLevel, 0.0, 0.0, {}, "a < b"}};
  const std::string page = registration_page(level, "\"<i>.csv").value();
  EXPECT_THAT(page, AllOf(HasSubstr("&lt;b&gt;L4"), HasSubstr("level a &lt; b"),
                          HasSubstr("&quot;&lt;i&gt;.csv"), HasSubstr(">refused</span>")));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("<b>L4<")), Not(HasSubstr("<i>.csv"))));
}

TEST(RegistrationPage, GivesTheSameBytesTwice) {
  EXPECT_TRUE(registration_page(exact(), "p").value() == registration_page(exact(), "p").value());
}

TEST(RegistrationJson, TurnsTheCovarianceIntoTheAxesOfTheModelsFile) {
  RegisteredLevel level = exact();
  std::array<double, 36> covariance{};
  covariance[0] = covariance[7] = covariance[14] = 4e-8;
  covariance[1] = covariance[6] = 1e-8;   // x with y
  covariance[2] = covariance[12] = 2e-8;  // x with z
  level.registration.uncertainty = nav::PoseUncertainty({}, covariance);
  const auto lps = registration_json(level, {Axes::kLps, 1e-3});
  const auto ras = registration_json(level, {Axes::kRas, 1e-3});
  const auto at = [](const auto& json, int r, int c) {
    return json["screws"][0]["entry_covariance_mm2"][r][c].template get<double>();
  };
  EXPECT_EQ(ras["covariance_frame"], "RAS");
  EXPECT_NEAR(at(lps, 0, 2), 0.02, 1e-12);
  EXPECT_NEAR(at(ras, 0, 2), -0.02, 1e-12) << "x turns, z does not";
  EXPECT_NEAR(at(ras, 0, 1), 0.01, 1e-12) << "both turn";
  EXPECT_NEAR(at(ras, 2, 2), 0.04, 1e-12);
  EXPECT_NEAR(lps["predicted_tre_mm"].get<double>(), std::sqrt(0.12), 1e-9);
}

TEST(RegistrationJson, HasNoRunnerUpWhereThereIsNoneAndNullForWhatHasNoBound) {
  RegisteredLevel level = exact();
  level.registration.uncertainty.reset();
  level.registration.predicted_tre_m = std::numeric_limits<double>::infinity();
  const auto json = registration_json(level, {});
  EXPECT_FALSE(json.contains("runner_up_rmse_mm"));
  EXPECT_THAT(json["ambiguity"].get<std::string>(), HasSubstr("no other pose"));
  EXPECT_TRUE(json["predicted_tre_mm"].is_null());
  EXPECT_TRUE(json["screws"][0]["predicted_target_tre_95_mm"].is_null());
}

TEST(RegistrationFigures, MeasureTheRunnerUpAtTheWorstScrew) {
  RegisteredLevel level = exact();
  const Transform<World, Vertebra>& pose = level.registration.world_from_vertebra;
  // Half round the spine: the left screws lie where the right ones were.
  const Transform<Vertebra, Vertebra> half_turn(rotation_from_vector({0, 0, 3.14159265358979}), {});
  level.registration.runner_up = pose * half_turn;
  level.registration.runner_up_rmse_m = 0.002;
  level.registration.log_likelihood_ratio = 3.0;
  double worst = 0.0;
  for (const nav::ScrewPlan& s : level.screws) {
    for (const Vec3 v : {s.entry.v, s.target.v}) {
      worst = std::max(worst, 2.0 * std::hypot(v.x, v.y));
    }
  }
  const auto distance = runner_up_distance(level);
  ASSERT_TRUE(distance.has_value());
  EXPECT_NEAR(distance->apart_m, worst, 1e-9);
  EXPECT_NEAR(distance->rotation_rad, 3.14159265, 1e-6);
  EXPECT_THAT(ambiguity_of(level), StartsWith("ambiguous: another pose, "));
  level.registration.log_likelihood_ratio = 50.0;
  EXPECT_THAT(ambiguity_of(level), StartsWith("unambiguous: the next best pose, "));
  level.registration.fits_better = "L5";
  EXPECT_EQ(ambiguity_of(level), "ambiguous: the points fit level L5 as well or better");
}

TEST(RegistrationFigures, SayWhatCouldNotBeChecked) {
  RegisteredLevel level = exact();
  level.registration.noise_m = 0.0002;
  level.registration.levels_compared = 4;
  level.registration.mirror_log_likelihood = -80.0;
  EXPECT_THAT(ambiguity_of(level), Not(HasSubstr("could not be checked")));
  EXPECT_EQ(registration_json(level, {})["mirror_margin"], 80.0);
  level.registration.mirror_log_likelihood = -3.0;
  EXPECT_THAT(ambiguity_of(level), HasSubstr("whether left and right are swapped could not be"));
  level.registration.mirror_log_likelihood = -std::numeric_limits<double>::infinity();
  EXPECT_THAT(ambiguity_of(level), Not(HasSubstr("could not be checked")));
  EXPECT_TRUE(registration_json(level, {})["mirror_margin"].is_null());
  level.registration.levels_compared = 0;
  EXPECT_THAT(ambiguity_of(level), HasSubstr("whether it is this level could not be checked"));
  level.registration.size = 1.01;
  level.registration.size_sd = 0.009;
  EXPECT_THAT(ambiguity_of(level), Not(HasSubstr("size")));
  level.registration.size_sd = 0.012;
  EXPECT_THAT(ambiguity_of(level), HasSubstr("size could be checked to 4 % only"));
}

TEST(RegistrationFigures, SayHowSureInPlainWords) {
  RegisteredLevel level = exact();
  level.registration.weakest = {nav::UncertainMotion::Kind::kCraniocaudal, 0.0004};
  level.registration.stroke_next = {nav::BonePlace::Part::kLamina, Side::kLeft,
                                    nav::BonePlace::Height::kMiddle};
  EXPECT_THAT(certainty_of(level),
              AllOf(StartsWith("95 % of errors at the screws are expected to be below 0.6"),
                    HasSubstr("Least certain: cranial-caudal shift (0.4 mm at the screws). To "
                              "improve: digitize the left lamina.")));
  level.registration.accepted = false;
  EXPECT_THAT(certainty_of(level), StartsWith("Were this pose right, "));
}

}  // namespace
}  // namespace orthonav::engine
