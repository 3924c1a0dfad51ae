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

/// A level whose left screw is planned, tracked and known, and whose right one is not done.
OperationResult with_clearances() {
  OperationState state = test::ScriptedOperation({"L4"}).session().operation();
  LevelState& level = state.levels[0];
  level.plan.screws[0].accepted_breach = "narrow <pedicle>";
  level.plan.screws[1].radius_m = 0.0;
  nav::ClearanceSpread spread;
  spread.lower_95_m = -0.0002;
  spread.grade_probability = {0.93, 0.07, 0, 0, 0};
  level.screws[0].done = true;
  level.screws[0].clearance_at_depth =
      nav::ScrewClearance{{0.0009, 0.018, {-1, 0, 0}, false, {}}, spread};
  OperationResult result = result_of(std::move(state), {});
  result.truth.levels[0].screws[0].clearance = nav::Clearance{-0.0023, 0.020, {0, 0, 1}, false, {}};
  return result;
}

TEST(ClearanceReport, HasWhatWasPlannedTrackedAndTrue) {
  const auto json = nlohmann::json::parse(report_json(with_clearances()));
  const auto& screw = json["levels"][0]["screws"][0];
  constexpr double kSearch_mm = 5e-3;
  EXPECT_NEAR(screw["planned"]["clearance_mm"].get<double>(), 5.0, kSearch_mm);
  EXPECT_EQ(screw["planned"]["grade"], "A");
  EXPECT_EQ(screw["planned"]["towards"], "tip");
  EXPECT_NEAR(screw["planned"]["diameter_mm"].get<double>(), 6.0, 1e-9);
  EXPECT_NEAR(screw["planned"]["length_mm"].get<double>(), 35.0, 1e-9);
  EXPECT_FALSE(screw["planned"].contains("clearance_95_mm")) << "nothing is registered";
  EXPECT_EQ(screw["planned"]["profile_mm"].size(), 15u) << "every 2 mm of 29";
  EXPECT_EQ(screw["planned"]["accepted_breach"], "narrow <pedicle>");
  EXPECT_EQ(screw["done"], true);
  EXPECT_NEAR(screw["tracked"]["clearance_mm"].get<double>(), 0.9, 1e-9);
  EXPECT_EQ(screw["tracked"]["towards"], "medial");
  EXPECT_NEAR(screw["tracked"]["arc_mm"].get<double>(), 18.0, 1e-9);
  EXPECT_NEAR(screw["tracked"]["clearance_95_mm"].get<double>(), -0.2, 1e-9);
  EXPECT_NEAR(screw["tracked"]["grade_probability"]["B"].get<double>(), 0.07, 1e-12);
  EXPECT_NEAR(screw["clearance_mm"].get<double>(), -2.3, 1e-9);
  EXPECT_EQ(screw["grade"], "C");
  EXPECT_EQ(screw["warned"], true);
  const auto& other = json["levels"][0]["screws"][1];
  for (const char* key : {"planned", "tracked", "clearance_mm", "grade"}) {
    EXPECT_FALSE(other.contains(key)) << key;
  }
}

/// The report of the same level, with other figures of the planned screw: medial, within 0.2 mm of
/// a breach.
nlohmann::json near_the_canal() {
  auto json = nlohmann::json::parse(report_json(with_clearances()));
  auto& screw = json["levels"][0]["screws"][0];
  screw["planned"].update(screw["tracked"]);
  screw["tracked"].erase("clearance_95_mm");
  return json;
}

TEST(ClearanceReport, ShowsThemOnThePage) {
  const std::string html = clearance_section(near_the_canal());
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
  auto& registration = result.state.levels[0].registration.emplace();
  const auto lacks = [&] {
    return nlohmann::json::parse(report_json(result))["levels"][0]["registration_only"].get<bool>();
  };
  registration.common.tip_m = 0.0005;
  EXPECT_FALSE(lacks());
  auto json = near_the_canal();
  EXPECT_THAT(clearance_section(json), Not(HasSubstr("registration only")));
  registration.common = {};
  EXPECT_TRUE(lacks());
  json["levels"][0]["registration_only"] = true;
  const std::string html = clearance_section(json);
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
  const auto json = nlohmann::json::parse(report_json(result_of(s.session().operation(), {})));
  const auto& screws = json["levels"][0]["screws"];
  constexpr double kSearch_mm = 5e-3;
  EXPECT_NEAR(screws[0]["planned"]["clearance_mm"].get<double>(), 5.0, kSearch_mm)
      << "the tip, in the box";
  EXPECT_NEAR(screws[0]["tracked"]["clearance_mm"].get<double>(), 1.5, kSearch_mm);
  EXPECT_GT(screws[0]["planned"]["profile_mm"].size(), 10u);
  EXPECT_TRUE(screws[1].contains("planned"));
  EXPECT_FALSE(screws[1].contains("tracked"));
  EXPECT_FALSE(screws[0].contains("clearance_mm")) << "nobody knows the truth";
}

}  // namespace
}  // namespace orthonav::engine::clearance_report_test
