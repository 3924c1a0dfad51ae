#include "engine/report/session_report.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/whole_log.h"

namespace orthonav::engine {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

LoggedTouch touch(bool first, double off_m, bool dropped) {
  LandmarkTouch touched;
  touched.first = first;
  touched.off_m = off_m;
  touched.limit_m = 0.0015;
  return {touched, dropped};
}

/// One level of two screws, one of them done, cut off before the second.
LoggedOperation cut_session() {
  LoggedOperation session;
  session.identity.case_name = "<spine>";
  session.identity.method = "best";
  session.records = 9;
  session.dropped_bytes = 12;
  session.first_time = Timestamp(std::chrono::seconds(101));
  session.last_time = Timestamp(std::chrono::milliseconds(165'570));
  OperatedLevel plan;
  plan.label = "L4";
  for (const double side : {1.0, -1.0}) {
    nav::ScrewPlan screw;
    screw.side = side > 0.0 ? Side::kLeft : Side::kRight;
    screw.entry = {{0.015 * side, 0.02, 0.0}};
    screw.target = {{0.015 * side, -0.02, 0.0}};
    screw.radius_m = 0.00275;
    plan.screws.push_back(screw);
  }
  LevelState level = planned_level(plan);
  level.attempts = 2;
  level.accepted = true;
  level.registration.emplace().rmse_m = 0.00131;
  level.registration->common.tip_m = 0.0004;
  level.check_points = {{{}, -0.0004, true}};
  ScrewState& left = level.screws[0];
  left.done = true;
  left.done_at = session.last_time;
  nav::ScrewGuidance at_depth;
  at_depth.angle_rad = 0.02;
  at_depth.tip_to_entry_m = 0.011;
  at_depth.tip_off_axis_m = 0.001;
  at_depth.depth_m = 0.0109;
  left.at_depth = at_depth;
  session.registrations = {{{}, 0, 1, false, "too few points", {}, {}},
                           {{}, 0, 2, true, "", {}, level.registration}};
  session.state.levels = {level};
  session.landmark_touches = {
      {touch(true, 0.0, false), touch(false, 0.0004, true), touch(false, 0.0023, false)}};
  session.strokes.resize(1);
  return session;
}

ScrewState& left_of(LoggedOperation& session) { return session.state.levels[0].screws[0]; }

nav::ScrewClearance clearance_of(double clearance_m, double lower_95_m) {
  nav::ScrewClearance clearance;
  clearance.least.clearance_m = clearance_m;
  clearance.spread = nav::ClearanceSpread{lower_95_m, {0.93, 0.07, 0.0, 0.0, 0.0}};
  return clearance;
}

/// Beyond its limit of the angle, and kept.
PlacedWire kept_wire() {
  PlacedWire wire;
  wire.axis.angle_rad = {0.05, 0.01};
  wire.axis.entry_m = {0.0011, 0.0006};
  wire.angle_limit_rad = 0.035;
  wire.entry_limit_m = 0.002;
  wire.kept = true;
  return wire;
}

TEST(SessionReport, SaysWhereTheToolsWentAndWhatWasNotMeasured) {
  LoggedOperation session = cut_session();
  EXPECT_THAT(session_page(session, "j"), HasSubstr("Tags and cameras in use: not recorded."));
  ScrewState& left = left_of(session);
  nav::ExecutedTrajectory executed;
  executed.axis = {{{0.0151, 0.0202, 0.0003}}, {0.0, -1.0, 0.0}};
  executed.depth_m = 0.0112;
  executed.pairs = 27;
  executed.point_covariance_m2 = {0.36e-6, 0, 0, 0, 0.36e-6, 0, 0, 0, 0.36e-6};
  executed.direction_covariance_rad2 = {1e-4, 0, 0, 0, 0, 0, 0, 0, 1e-4};
  left.executed = executed;
  left.clearance_at_depth = clearance_of(0.002, 0.001);
  ScrewState& right = session.state.levels[0].screws[1];
  right.done = true;
  right.done_at = session.last_time;
  session.calibration = CalibrationInUse{{{"guide", 0.003, 0.004, 0.001}}, {}};
  const std::string page = session_page(session, "j");
  EXPECT_THAT(page, HasSubstr("15.1, 20.2, 0.3 ± 0.60"));
  EXPECT_THAT(page, HasSubstr("0.000, \u22121.000, 0.000 ± 0.57"));
  EXPECT_THAT(page, HasSubstr("A 93 %, B 7 %"));
  EXPECT_THAT(page, ContainsRegex("L4 right</th><td data-label=[^>]*>not measured</td>"));
  EXPECT_THAT(page, ContainsRegex("guide</th><td [^>]*>0.40 ± 0.10</td><td [^>]*>0.30</td>"));
  EXPECT_THAT(page, HasSubstr("Cameras against their calibration: not measured."));
  const auto json = nlohmann::json::parse(session_json(session));
  EXPECT_EQ(json["levels"][0]["screws"][0]["executed"]["pairs"], 27);
  EXPECT_EQ(json["levels"][0]["screws"][1]["not_measured"][0], "executed");
  EXPECT_EQ(json["calibration"]["not_measured"][0], "cameras");
  left.executed->point_covariance_m2.reset();
  left.executed->direction_covariance_rad2.reset();
  EXPECT_THAT(session_page(session, "j"), HasSubstr("± unknown"));
}

TEST(SessionReport, SaysWhatWasPlannedInSurgery) {
  LoggedOperation session = cut_session();
  EXPECT_THAT(session_page(session, "j"), Not(HasSubstr("planned in surgery")));
  EXPECT_THAT(session_json(session), Not(HasSubstr("planned_in_surgery")));
  LevelState& level = session.state.levels[0];
  nav::ScrewPlan& plan = level.plan.screws[1];
  level.screws[1].earlier_plans = {plan};
  plan.entry.v.z += 0.001;
  plan.target.v.z += 0.001;
  plan.radius_m = 0.003;
  EXPECT_THAT(session_page(session, "j"),
              HasSubstr("planned in surgery: entry moved 1.0 mm cranial, 6.0 \u00d7 40 mm instead "
                        "of 5.5 \u00d7 40 mm"));
  const auto json = nlohmann::json::parse(session_json(session));
  const auto& screws = json["levels"][0]["screws"];
  EXPECT_FALSE(screws[0].contains("planned_in_surgery"));
  EXPECT_NEAR(screws[1]["planned_in_surgery"]["entry_cranial_mm"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(screws[1]["planned_in_surgery"]["diameter_to_mm"].get<double>(), 6.0, 1e-9);
}

TEST(SessionReport, SaysWhichErrorsLackWhatAllStrokesShare) {
  LoggedOperation session = cut_session();
  LevelState& level = session.state.levels[0];
  level.predicted.emplace_back().entry_m = 0.0006;
  level.screws[0].clearance_at_depth = clearance_of(0.002, 0.0012);
  EXPECT_THAT(session_page(session, "j"), Not(HasSubstr("registration only")));
  level.registration->common = {};
  const std::string page = session_page(session, "j");
  EXPECT_THAT(page, HasSubstr("0.60 <small>registration only</small>"));
  EXPECT_THAT(page, HasSubstr("1.20 <small>registration only</small>"));
  EXPECT_EQ(nlohmann::json::parse(session_json(session))["levels"][0]["registration_only"], true);
}

TEST(SessionReport, SaysFirstOfAllThatTheSessionWasCutOffAndWhen) {
  const std::string page = session_page(cut_session(), "a/operation.resume");
  const std::size_t cut = page.find("This session was cut off");
  ASSERT_NE(cut, std::string::npos);
  EXPECT_LT(cut, page.find("<table"));
  EXPECT_THAT(page, HasSubstr("its last record is of 02:45.57 on the headset's clock, 64.6 s after "
                              "the first; one more record was torn and is not used"));
  EXPECT_THAT(page, HasSubstr("a/operation.resume"));
  EXPECT_THAT(page, HasSubstr("&lt;spine&gt;"));
}

TEST(SessionReport, TellsWhatPositionsAreRelativeTo) {
  LoggedOperation session = cut_session();
  EXPECT_THAT(session_page(session, "j"), HasSubstr("the headset\u2019s map"));
  session.identity.patient_reference = true;
  EXPECT_THAT(session_page(session, "j"), HasSubstr("the patient reference"));
  EXPECT_EQ(nlohmann::json::parse(session_json(session))["patient_reference"], true);
}

TEST(SessionReport, TellsOfEveryRegistrationAndTouchAndInventsNoFigure) {
  const std::string page = session_page(cut_session(), "j");
  EXPECT_THAT(page, HasSubstr("<span class=bad>refused</span> too few points"));
  EXPECT_THAT(page, HasSubstr("<span class=good>passed</span>"));
  EXPECT_THAT(page, HasSubstr(">1 of 2</td>"));
  EXPECT_THAT(page, HasSubstr(">recorded, 0.4 (taken back), <span class=bad>2.3</span></td>"));
  EXPECT_THAT(page, HasSubstr("not done"));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  const auto json = nlohmann::json::parse(session_json(cut_session()));
  for (const char* key : {"frames", "seed"}) {
    EXPECT_FALSE(json.contains(key)) << key;
  }
  EXPECT_FALSE(json["levels"][0].contains("tre_mm"));
}

TEST(SessionReport, TellsHowEveryWireWasMeasuredKeptRedoneOrNot) {
  LoggedOperation session = cut_session();
  ScrewState& left = left_of(session);
  ScrewState& right = session.state.levels[0].screws[1];
  right.done = true;
  right.done_at = session.last_time;
  EXPECT_THAT(session_page(session, "j"), Not(HasSubstr("the trajectory was not measured")));
  left.wire = {true, kept_wire()};
  right.wire = {true, std::nullopt};
  left.redone = 1;
  const std::string page = session_page(session, "j");
  EXPECT_THAT(page,
              HasSubstr("<span class=bad>2.9 \u00b1 0.6\u00b0, 1.1 \u00b1 0.6 mm</span>, kept; "
                        "redone</td>"));
  EXPECT_THAT(page, HasSubstr("the trajectory was not measured"));
  const auto json = nlohmann::json::parse(session_json(session));
  const auto& screws = json["levels"][0]["screws"];
  EXPECT_NEAR(screws[0]["wire"]["angle_deg"].get<double>(), 2.8648, 1e-4);
  EXPECT_DOUBLE_EQ(screws[0]["wire"]["entry_sd_mm"], 0.6);
  EXPECT_EQ(screws[0]["wire"]["kept"], true);
  EXPECT_EQ(screws[0]["redone"], 1);
  EXPECT_EQ(screws[1]["wire"], "not measured");
  left.wire.measured->angle_limit_rad = 0.06;
  EXPECT_THAT(session_page(session, "j"),
              HasSubstr(">2.9 \u00b1 0.6\u00b0, 1.1 \u00b1 0.6 mm; redone</td>"));
}

TEST(SessionReport, HasTheFiguresInTheKeysOfAReport) {
  const auto json = nlohmann::json::parse(session_json(cut_session()));
  EXPECT_EQ(json["completed"], false);
  EXPECT_THAT(json["why_not"].get<std::string>(), HasSubstr("The log has no end"));
  EXPECT_EQ(json["session"]["cut"], true);
  EXPECT_EQ(json["session"]["records"], 9);
  EXPECT_DOUBLE_EQ(json["session"]["end_s"], 165.57);
  const auto& level = json["levels"][0];
  EXPECT_EQ(level["label"], "L4");
  EXPECT_DOUBLE_EQ(level["rmse_mm"], 1.31);
  EXPECT_DOUBLE_EQ(level["check_points_mm"][0], -0.4);
  EXPECT_EQ(level["landmark"][0]["first"], true);
  EXPECT_FALSE(level["landmark"][0].contains("off_mm"));
  EXPECT_EQ(level["landmark"][1]["dropped"], true);
  EXPECT_DOUBLE_EQ(level["landmark"][2]["off_mm"], 2.3);
  EXPECT_EQ(level["landmark"][2]["within"], false);
  EXPECT_EQ(level["screws"][0]["done"], true);
  EXPECT_DOUBLE_EQ(level["screws"][0]["at_depth"]["depth_mm"], 10.9);
  EXPECT_EQ(level["screws"][1]["done"], false);
  EXPECT_FALSE(level["screws"][1].contains("at_depth"));
}

/// The log of a whole operation, cut at every record and at every byte of its last two.
TEST(SessionReport, IsMadeOfALogThatWasCutAnywhere) {
  const std::string whole = test::whole_log();
  ASSERT_GT(whole.size(), 10'000U);
  const auto all = read_records(whole, "whole");
  ASSERT_TRUE(all.ok());
  ASSERT_GT(all->records.size(), 50U);
  const auto expect_a_report = [](LoggedOperation session, bool is_whole) {
    EXPECT_EQ(session.ended, is_whole);
    const std::string page = session_page(session, "cut");
    EXPECT_EQ(page.find("This session was cut off") == std::string::npos, is_whole);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_FALSE(session_json(session).empty());
  };
  for (std::size_t n = 1; n <= all->records.size(); ++n) {
    SCOPED_TRACE(n);
    const auto session =
        LoggedOperation::from({all->records.begin(), all->records.begin() + n}, "cut");
    ASSERT_TRUE(session.ok()) << session.error().message;
    EXPECT_EQ(session->records, n);
    expect_a_report(*session, n == all->records.size());
  }
  const std::size_t last_two = all->records.back().payload.size() +
                               all->records[all->records.size() - 2].payload.size() + 40;
  for (std::size_t size = whole.size() - last_two; size < whole.size(); ++size) {
    const auto cut = read_records(std::string_view(whole).substr(0, size), "cut");
    ASSERT_TRUE(cut.ok());
    EXPECT_GE(cut->records.size() + 2, all->records.size());
    EXPECT_LT(cut->records.size(), all->records.size());
  }
}

TEST(SessionReport, BeginsWithWhatWasPlacedAndItsWarnings) {
  LoggedOperation session = cut_session();
  ScrewState& left = left_of(session);
  left.wire = {true, kept_wire()};
  left.clearance_at_depth = clearance_of(0.0004, -0.0012);
  const std::string page = session_page(session, "j");
  EXPECT_THAT(page, HasSubstr("This session was cut off: 1 of 2 screws placed; their true distance "
                              "from the plan is unknown; 0 of 1 measured within the "
                              "limits.</h2>"));
  EXPECT_THAT(page,
              HasSubstr("<li>L4 left: the trajectory was measured 2.9° and 1.1 mm from the plan, "
                        "beyond a limit, and kept</li><li>L4 left: as tracked, a breach of "
                        "the cortex cannot be ruled out (95 % bound −1.2 mm)</li>"));
}

TEST(SessionReport, TellsOfASessionThatEnded) {
  LoggedOperation session = cut_session();
  session.dropped_bytes = 0;
  session.ended = session.done = true;
  EXPECT_THAT(session_page(session, "j"), HasSubstr("Operation completed"));
  EXPECT_EQ(nlohmann::json::parse(session_json(session))["completed"], true);
  session.done = false;
  session.reason = "stopped by SIGTERM, ended at rod";
  EXPECT_THAT(session_page(session, "j"), HasSubstr("Operation incomplete"));
  EXPECT_THAT(session_page(session, "j"), HasSubstr("; stopped by SIGTERM, ended at rod."));
  EXPECT_EQ(nlohmann::json::parse(session_json(session))["why_not"], session.reason);
  EXPECT_THAT(ending_of(LoggedOperation{}), HasSubstr("no record after its first"));
}

}  // namespace
}  // namespace orthonav::engine
