#include "engine/report/operation_result.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "engine/report/levels_section.h"
#include "engine/report/screws_section.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A rod with a template through so many heads.
RodState templated(nav::Side side, std::size_t heads, double length_m) {
  RodState rod{.side = side};
  rod.heads.resize(heads);
  rod.rod.emplace().length_m = length_m;
  return rod;
}

/// A level whose right wire missed the bone, and both rods.
OperationResult measured() {
  OperationState state;
  LevelState& level = state.levels.emplace_back();
  level.plan.label = "L4";
  level.plan.screws = {{.side = nav::Side::kLeft}, {.side = nav::Side::kRight}};
  level.screws = {{.done = true}, {.done = true}};
  level.accepted = true;
  level.attempts = 1;
  level.registration.emplace().rmse_m = 0.0016;
  level.registration->points = 800;
  level.digitization_s = 120.5;
  state.rods = {templated(nav::Side::kLeft, 2, 0.040), templated(nav::Side::kRight, 2, 0.042)};
  OperationResult result = result_of(std::move(state), {});
  result.method = "paper";
  result.seed = 3;
  result.case_name = "phantom";
  result.truth.levels[0].tre_m = 0.002;
  result.truth.levels[0].screws = {
      {.known = true, .angle_error_rad = 0.05, .entry_error_m = 0.0025},
      {.known = true, .angle_error_rad = 0.04}};
  result.truth.rods = {RodTruth{0.001, 0.002}, RodTruth{-0.003, 0.001}};
  for (int i = 1; i <= 100; ++i) {
    result.loop.intervals_ms.add(i);
  }
  result.loop.displayed = 101;
  return result;
}

TEST(ReportJson, HoldsWhatTheFormatSays) {
  const auto json = nlohmann::json::parse(report_json(measured()));
  EXPECT_EQ(json["method"], "paper");
  EXPECT_EQ(json["seed"], 3);
  EXPECT_EQ(json["case"], "phantom");
  const auto& level = json["levels"][0];
  EXPECT_EQ(level["label"], "L4");
  EXPECT_EQ(level["accepted"], true);
  EXPECT_EQ(level["attempts"], 1);
  EXPECT_DOUBLE_EQ(level["rmse_mm"], 1.6);
  EXPECT_DOUBLE_EQ(level["tre_mm"], 2.0);
  EXPECT_EQ(level["points"], 800);
  EXPECT_DOUBLE_EQ(level["digitization_s"], 120.5);
  EXPECT_EQ(level["screws"][0]["side"], "left");
  EXPECT_NEAR(level["screws"][0]["angle_error_deg"].get<double>(), 2.8648, 1e-4);
  EXPECT_DOUBLE_EQ(level["screws"][0]["entry_error_mm"], 2.5);
  EXPECT_FALSE(level["screws"][1].contains("entry_error_mm")) << "the wire missed the bone";
  EXPECT_EQ(json["rod"]["side"], "left");
  EXPECT_EQ(json["frames"]["displayed"], 101);
  EXPECT_NEAR(json["frames"]["median_ms"], 50.0, 0.005 * 50.0);
  EXPECT_NEAR(json["frames"]["p99_ms"], 99.0, 0.005 * 99.0);
}

TEST(ReportJson, HoldsWhatWasPlannedInSurgery) {
  test::ScriptedOperation s({"L4"});
  s.accepts_first_level();
  s.says("next");
  s.says("move cranial two");
  const auto json = nlohmann::json::parse(report_json(result_of(s.session().operation(), {})));
  const auto& screws = json["levels"][0]["screws"];
  EXPECT_NEAR(screws[0]["planned_in_surgery"]["entry_cranial_mm"].get<double>(), 2.0, 1e-9);
  EXPECT_EQ(screws[0]["planned_in_surgery"]["text"], "entry moved 2.0 mm cranial");
  EXPECT_FALSE(screws[1].contains("planned_in_surgery"));
  EXPECT_THAT(screws_section(json),
              ::testing::HasSubstr("planned in surgery: entry moved 2.0 mm cranial"));
}

TEST(ReportJson, HoldsTheDistancesOfCheckPointsWhereThereAreAny) {
  EXPECT_FALSE(
      nlohmann::json::parse(report_json(measured()))["levels"][0].contains("check_points_mm"));
  test::ScriptedOperation s({"L5"}, {}, Verification::kByTouch);
  s.registers_first_level();
  s.touches({0.0, 0.0213, 0.0});
  s.touches({0.02, 0.0195, 0.0});
  const auto result = result_of(s.session().operation(), {});
  const auto json = nlohmann::json::parse(report_json(result));
  const auto& distances = json["levels"][0]["check_points_mm"];
  ASSERT_EQ(distances.size(), 2u);
  EXPECT_NEAR(distances[0].get<double>(), 1.3, 1e-6);
  EXPECT_NEAR(distances[1].get<double>(), -0.5, 1e-6);
}

TEST(ReportJson, TellsHowEveryWireWasMeasured) {
  OperationResult result = measured();
  EXPECT_FALSE(
      nlohmann::json::parse(report_json(result))["levels"][0]["screws"][0].contains("wire"))
      << "nobody was asked";
  PlacedWire wire;
  wire.axis.angle_rad = {0.05, 0.01};
  wire.axis.entry_m = {0.0011, 0.0006};
  wire.angle_limit_rad = 0.035;
  wire.entry_limit_m = 0.002;
  wire.kept = true;
  result.state.levels[0].screws[0].wire = {true, wire};
  result.state.levels[0].screws[0].redone = 1;
  result.state.levels[0].screws[1].wire = {true, {}};
  const auto json = nlohmann::json::parse(report_json(result));
  const auto& left = json["levels"][0]["screws"][0];
  EXPECT_NEAR(left["wire"]["angle_deg"].get<double>(), 2.8648, 1e-4);
  EXPECT_NEAR(left["wire"]["angle_sd_deg"].get<double>(), 0.57296, 1e-4);
  EXPECT_DOUBLE_EQ(left["wire"]["entry_mm"], 1.1);
  EXPECT_DOUBLE_EQ(left["wire"]["entry_sd_mm"], 0.6);
  EXPECT_EQ(left["wire"]["within"], false);
  EXPECT_EQ(left["wire"]["kept"], true);
  EXPECT_EQ(left["redone"], 1);
  EXPECT_EQ(json["levels"][0]["screws"][1]["wire"], "not measured");
}

TEST(ReportJson, LeavesErrorsOutWhereThereIsNoTruth) {
  test::ScriptedOperation s({"L5"});
  s.accepts_first_level();
  const auto result = result_of(s.session().operation(), {});
  const auto json = nlohmann::json::parse(report_json(result));
  EXPECT_EQ(json["completed"], false);
  EXPECT_TRUE(json["levels"][0]["accepted"]);
  EXPECT_FALSE(json["levels"][0].contains("tre_mm"));
  EXPECT_FALSE(json["levels"][0]["screws"][0].contains("angle_error_deg"));
  EXPECT_FALSE(json["rod"].contains("length_error_mm"));
}

TEST(ReportJson, HasOneLengthOfEachRodAndNoMean) {
  OperationResult result = measured();
  const auto rod = [&] { return nlohmann::json::parse(report_json(result))["rod"]; };
  ASSERT_EQ(rod()["sides"].size(), 2u);
  EXPECT_DOUBLE_EQ(rod()["sides"][0]["length_mm"], 40.0);
  EXPECT_DOUBLE_EQ(rod()["sides"][1]["length_mm"], 42.0);
  EXPECT_EQ(rod()["side"], "left");
  EXPECT_DOUBLE_EQ(rod()["length_mm"], 40.0);
  EXPECT_DOUBLE_EQ(rod()["length_error_mm"], 1.0);
  EXPECT_DOUBLE_EQ(rod()["head_error_mm"], 2.0);
  result.state.rods[0].heads.resize(1);
  result.state.rods[0].rod.reset();
  EXPECT_EQ(rod()["side"], "right") << "the left rod has no template";
  EXPECT_DOUBLE_EQ(rod()["length_mm"], 42.0);
  result.state.rods[1] = {.side = nav::Side::kRight};
  EXPECT_FALSE(rod().contains("length_mm"));
}

TEST(ReportHtml, HasEachRodByItselfAndNoneThatWasNotTouched) {
  OperationResult result = measured();
  const auto page = [&] { return rods_section(nlohmann::json::parse(report_json(result))); };
  EXPECT_THAT(page(), AllOf(HasSubstr("<p>left: length <b>40.0 mm</b>, heads touched 2, length "
                                      "error 1.00 mm, error of the heads 2.00 mm.</p>"),
                            HasSubstr("<p>right: length <b>42.0 mm</b>, heads touched 2")));
  result.state.rods[1] = {.side = nav::Side::kRight};
  result.truth.rods = {};
  EXPECT_THAT(page(), HasSubstr("<p>left: length <b>40.0 mm</b>, heads touched 2.</p></section>"));
  result.state.rods[0].heads.resize(1);
  result.state.rods[0].rod.reset();
  EXPECT_THAT(page(), HasSubstr("<p>left: no template, heads touched 1.</p></section>"));
  // Both are planned, none was touched.
  result.state.rods[0].heads.clear();
  result.state.levels.push_back(result.state.levels[0]);
  result.truth.levels.push_back(result.truth.levels[0]);
  EXPECT_THAT(page(), HasSubstr("No rod was templated"));
}

TEST(ReportHtml, LeavesCellsOfWhatWasNotAttemptedEmpty) {
  OperationResult result = measured();
  const auto page = [&] {
    const auto report = nlohmann::json::parse(report_json(result));
    return levels_section(report) + screws_section(report);
  };
  EXPECT_THAT(page(), HasSubstr("RMSE [mm]\">1.60</td>"));
  EXPECT_THAT(page(), HasSubstr("entry error [mm]\">\u2013</td>")) << "the wire missed the bone";
  OperationState planned;
  planned.levels.push_back(planned_level({.label = "L4", .screws = {{}}}));
  result = result_of(std::move(planned), {});
  EXPECT_THAT(page(), HasSubstr("not placed"));
  EXPECT_THAT(page(), Not(HasSubstr("\u2013</td>")));
}

TEST(ReportJson, HasRodsOnlyWhereTheyWerePlanned) {
  const auto rod = [](std::vector<std::string> labels) {
    test::ScriptedOperation s(std::move(labels));
    const auto result = result_of(s.session().operation(), {});
    return nlohmann::json::parse(report_json(result))["rod"];
  };
  EXPECT_EQ(rod({"L5"}), nlohmann::json::object());
  EXPECT_EQ(rod({"L4", "L5"})["sides"].size(), 2u) << "not reached, but planned";
}

TEST(ReportJson, LeavesFiguresOutWhereNothingWasMeasured) {
  OperationState state;
  state.levels.emplace_back();
  const auto json = nlohmann::json::parse(report_json(result_of(std::move(state), {})));
  for (const char* key : {"rmse_mm", "points", "digitization_s"}) {
    EXPECT_FALSE(json["levels"][0].contains(key)) << key;
  }
  EXPECT_FALSE(json.contains("seed"));
  EXPECT_FALSE(json["frames"].contains("p99_ms"));
  EXPECT_FALSE(nlohmann::json::parse(timing_json({}))["draw_wall"].contains("median_ms"));
}

TEST(EndNote, SaysWhereAnOperationEndedAndWhatItWasToldLast) {
  test::ScriptedOperation s({"L4", "L5"});
  EndNote note;
  s.session().observe(&note);
  const auto why_not = [&] {
    OperationResult result = result_of(s.session().operation(), {});
    note.explain(result);
    return result.why_not;
  };
  EXPECT_EQ(why_not(), "ended at setup of L4");
  s.unusable = "99 points, needs at least 100";
  s.says("start");
  s.strokes(3);
  s.says("save");
  s.does({ClickerAction::kDoubleClick});
  EXPECT_EQ(why_not(),
            "ended at digitize of L4; last registration (L4) refused: 99 points, needs at least "
            "100");
  OperationResult broken = result_of(s.session().operation(), {});
  broken.loop.ended = Error{"camera gone"};
  note.explain(broken);
  EXPECT_THAT(broken.why_not, ::testing::EndsWith("needs at least 100; camera gone"));
  OperationResult whole;
  whole.completed = true;
  note.explain(whole);
  EXPECT_EQ(whole.why_not, "");
}

TEST(Quantile, IsTheNearestRank) {
  EXPECT_FALSE(quantile({}, 0.5).has_value());
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2.0);
  EXPECT_EQ(quantile({4, 3, 1, 2}, 0.99), 4.0);
  EXPECT_EQ(quantile({7}, 0.0), 7.0);
}

TEST(ReportJson, DoesNotDependOnWallTime) {
  OperationResult a = measured();
  OperationResult b = measured();
  b.loop.step_wall_ms.add(1);
  b.loop.draw_wall_ms.add(9);
  EXPECT_EQ(report_json(a), report_json(b));
}

TEST(OperationPlan, TakesTheTwoLowestLevelsInTheOrderOfTheCase) {
  const auto operation = plan_operation(phantom({"L3", "L4", "L5"}));
  ASSERT_TRUE(operation.ok()) << operation.error().message;
  ASSERT_EQ(operation->levels.size(), 2u);
  EXPECT_EQ(operation->levels[0].label, "L4");
  EXPECT_EQ(operation->levels[1].label, "L5");
  EXPECT_TRUE(operation->check().empty());
}

TEST(OperationPlan, TakesTheTwoLowestOfOneScanWhereAllModelsShareAFrame) {
  Case scan = phantom();
  for (CaseLevel& level : scan.levels) {
    for (Vec3& v : level.mesh.vertices_m) {
      v = (level.spine_from_vertebra * Point<Vertebra>{v}).v;
    }
    for (nav::ScrewPlan& screw : level.screws) {
      screw.entry = {(level.spine_from_vertebra * screw.entry).v};
      screw.target = {(level.spine_from_vertebra * screw.target).v};
    }
    level.spine_from_vertebra = {};
  }
  ASSERT_TRUE(scan.check().empty());
  EXPECT_THAT(levels_to_operate(scan).value(), ::testing::ElementsAre("L4", "L5"));
  // By where they lie, not by their order in the file.
  std::reverse(scan.levels.begin(), scan.levels.end());
  EXPECT_THAT(levels_to_operate(scan).value(), ::testing::ElementsAre("L5", "L4"));
}

TEST(OperationResult, OfRodsAloneIsCompleteOnlyWithARod) {
  const auto outcome = [](int heads) {
    test::ScriptedOperation s(std::vector<std::string>{});
    EndNote end;
    s.session().observe(&end);
    s.says("start");
    for (int i = 0; i < heads; ++i) {
      s.touches({0.02, 0.03, 0.04 * i});
    }
    s.says("done");
    s.says("done");
    OperationResult result = result_of(s.session().operation(), {.done = true});
    end.explain(result);
    return result;
  };
  EXPECT_FALSE(outcome(1).completed);
  EXPECT_EQ(outcome(1).why_not, "no rod: no side has two heads");
  const OperationResult whole = outcome(2);
  EXPECT_TRUE(whole.completed);
  const auto sides = nlohmann::json::parse(report_json(whole))["rod"]["sides"];
  ASSERT_EQ(sides.size(), 1u) << "a side without heads has no rod";
  const auto& side = sides[0];
  EXPECT_GT(side["time_s"].get<double>(), 0.0);
  EXPECT_NEAR(side["cut_length_mm"].get<double>(), 50.0, 1e-3);
  EXPECT_DOUBLE_EQ(side["seat_by_pointer_mm"].get<double>(), 6.0);
  EXPECT_EQ(side["instructions"], nlohmann::json::array());
}

TEST(OperationPlan, RefusesLevelsThatAreNotThereOrNamedTwice) {
  const Case lumbar = phantom({"L4", "L5"});
  const auto unknown = plan_operation(lumbar, {"L9"});
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.error().message, ::testing::HasSubstr("no level 'L9' (it has: L4, L5)"));
  EXPECT_FALSE(plan_operation(lumbar, {"L5", "L5"}).ok());
  EXPECT_TRUE(plan_operation(lumbar, {"L5"}).ok());
}

}  // namespace
}  // namespace orthonav::engine
