#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/report/clearance_section.h"
#include "engine/report/operation_result.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::clearance_report_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A level whose left screw is planned, tracked and executed, and whose right one is not done.
OperationResult with_clearances() {
  OperationResult result;
  LevelOutcome level;
  level.label = "L4";
  ScrewOutcome left{Side::kLeft, true, {}, {}};
  nav::Clearance planned{0.0015, 0.018, {-1, 0, 0}, false, {}};
  nav::ClearanceSpread spread;
  spread.lower_95_m = -0.0002;
  spread.grade_probability = {0.93, 0.07, 0, 0, 0};
  left.planned = nav::ScrewClearance{planned, spread};
  left.planned_profile_m = {0.004, 0.0015};
  left.size = nav::ScrewCylinder{{}, {0, -1, 0}, 0.040, 0.00325};
  left.accepted_breach = "narrow <pedicle>";
  left.tracked = nav::ScrewClearance{{0.0009, 0.018, {-1, 0, 0}, false, {}}, std::nullopt};
  left.executed = nav::Clearance{-0.0023, 0.020, {0, 0, 1}, false, {}};
  level.screws = {left, {Side::kRight, false, {}, {}}};
  result.levels.push_back(level);
  return result;
}

TEST(ClearanceReport, HasWhatWasPlannedTrackedAndTrue) {
  const auto json = nlohmann::json::parse(report_json(with_clearances()));
  const auto& screw = json["levels"][0]["screws"][0];
  EXPECT_NEAR(screw["planned"]["clearance_mm"].get<double>(), 1.5, 1e-9);
  EXPECT_EQ(screw["planned"]["grade"], "A");
  EXPECT_NEAR(screw["planned"]["diameter_mm"].get<double>(), 6.5, 1e-9);
  EXPECT_NEAR(screw["planned"]["length_mm"].get<double>(), 40.0, 1e-9);
  EXPECT_EQ(screw["done"], true);
  EXPECT_EQ(screw["planned"]["towards"], "medial");
  EXPECT_NEAR(screw["planned"]["arc_mm"].get<double>(), 18.0, 1e-9);
  EXPECT_NEAR(screw["planned"]["clearance_95_mm"].get<double>(), -0.2, 1e-9);
  EXPECT_NEAR(screw["planned"]["grade_probability"]["B"].get<double>(), 0.07, 1e-12);
  EXPECT_EQ(screw["planned"]["profile_mm"].size(), 2u);
  EXPECT_EQ(screw["planned"]["accepted_breach"], "narrow <pedicle>");
  EXPECT_NEAR(screw["tracked"]["clearance_mm"].get<double>(), 0.9, 1e-9);
  EXPECT_FALSE(screw["tracked"].contains("clearance_95_mm"));
  EXPECT_NEAR(screw["clearance_mm"].get<double>(), -2.3, 1e-9);
  EXPECT_EQ(screw["grade"], "C");
  const auto& other = json["levels"][0]["screws"][1];
  for (const char* key : {"planned", "tracked", "clearance_mm", "grade"}) {
    EXPECT_FALSE(other.contains(key)) << key;
  }
}

TEST(ClearanceReport, ShowsThemOnThePage) {
  const auto json = nlohmann::json::parse(report_json(with_clearances()));
  const std::string html = clearance_section(json);
  EXPECT_THAT(html, HasSubstr("medial, 18 mm"));
  EXPECT_THAT(html, HasSubstr("A 93 %, B 7 %"));
  EXPECT_THAT(html, HasSubstr("<td class=bad data-label=\"truth [mm]\">\u22122.30</td><td "
                              "data-label=\"true grade\">C</td>"));
  EXPECT_THAT(html, HasSubstr("narrow &lt;pedicle&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("L4 right")));
  EXPECT_EQ(clearance_section({{"levels", {{{"label", "L4"}}}}}), "");
}

TEST(ClearanceReport, SaysWhereABoundLacksWhatAllStrokesShare) {
  auto result = with_clearances();
  result.levels[0].predicted_tre_m = 0.0006;
  EXPECT_THAT(clearance_section(nlohmann::json::parse(report_json(result))),
              Not(HasSubstr("registration only")));
  result.levels[0].registration_only = true;
  const std::string html = clearance_section(nlohmann::json::parse(report_json(result)));
  EXPECT_THAT(html, HasSubstr("\u22120.20 <small>registration only</small></td>"));
  // A figure without a bound has no remark beside it.
  EXPECT_THAT(html, Not(HasSubstr("\u2013 <small>registration only")));
}

TEST(ClearanceReport, OfASessionHasThePlansAndTheTrackedOnes) {
  test::ScriptedOperation s({"L5"});
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = test::guide_at({0.0255, 0.020, 0.0}, 0.0);
  s.pairs(2);
  s.says("next");
  const auto result = outcome_of(s.session().levels(), s.session().rods(), {});
  const auto& screws = result.levels[0].screws;
  constexpr double kSearch_m = 5e-6;
  EXPECT_NEAR(screws[0].planned->least.clearance_m, 0.005, kSearch_m) << "the tip, in the box";
  EXPECT_NEAR(screws[0].tracked->least.clearance_m, 0.0015, kSearch_m);
  EXPECT_GT(screws[0].planned_profile_m.size(), 10u);
  EXPECT_TRUE(screws[1].planned.has_value());
  EXPECT_FALSE(screws[1].tracked.has_value());
  EXPECT_FALSE(screws[0].executed.has_value()) << "nobody knows the truth";
}

}  // namespace
}  // namespace orthonav::engine::clearance_report_test
