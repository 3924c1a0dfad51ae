#include "engine/report/session_report.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/session/journal_reader.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

/// One level of two screws, one of them done, cut off before the second.
SessionRecord cut_session() {
  SessionRecord session;
  session.case_name = "<spine>";
  session.method = "best";
  session.has_plan = true;
  session.lines = 9;
  session.cut = true;
  session.last_line_torn = true;
  session.begin = Timestamp(std::chrono::seconds(101));
  session.end = Timestamp(std::chrono::milliseconds(165'570));
  RecordedRegistration registration;
  registration.level = "L4";
  registration.attempt = 2;
  registration.passed = true;
  registration.rmse_m = 0.00131;
  session.registrations = {registration};
  RecordedLevel level;
  level.label = "L4";
  level.attempts = 2;
  level.accepted = true;
  level.registration = 0;
  level.checks = {{-0.0004, true}};
  level.landmark = {{true, 0.0, 0.0015, true, false},
                    {false, 0.0004, 0.0015, true, true},
                    {false, 0.0023, 0.0015, false, false}};
  level.screws = {{Side::kLeft, true, session.end, RecordedPose{0.02, 0.011, 0.001, 0.0109}},
                  {Side::kRight, false, {}, {}}};
  session.levels = {level};
  return session;
}

TEST(SessionReport, SaysWhereTheToolsWentAndWhatWasNotMeasured) {
  SessionRecord session = cut_session();
  EXPECT_THAT(session_page(session, "j"), HasSubstr("Where the tools went: not recorded."));
  EXPECT_THAT(session_page(session, "j"), HasSubstr("Tags and cameras in use: not recorded."));
  RecordedScrew& left = session.levels[0].screws[0];
  nav::ExecutedTrajectory executed;
  executed.axis = {{{0.0151, 0.0202, 0.0003}}, {0.0, -1.0, 0.0}};
  executed.depth_m = 0.0112;
  executed.pairs = 27;
  executed.point_covariance_m2 = {0.36e-6, 0, 0, 0, 0.36e-6, 0, 0, 0, 0.36e-6};
  executed.direction_covariance_rad2 = {1e-4, 0, 0, 0, 0, 0, 0, 0, 1e-4};
  left.executed = executed;
  left.at_depth->grade = "A";
  left.at_depth->grade_probability = {0.93, 0.07, 0.0, 0.0, 0.0};
  session.levels[0].screws[1].done = true;
  session.levels[0].screws[1].not_measured = {"executed", "clearance"};
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
  executed.point_covariance_m2.reset();
  executed.direction_covariance_rad2.reset();
  left.executed = executed;
  EXPECT_THAT(session_page(session, "j"), HasSubstr("± not known"));
}

TEST(SessionReport, SaysWhatWasPlannedInSurgery) {
  SessionRecord session = cut_session();
  EXPECT_THAT(session_page(session, "j"), Not(HasSubstr("planned in surgery")));
  EXPECT_THAT(session_json(session), Not(HasSubstr("planned_in_surgery")));
  nav::ScrewDifference difference;
  difference.entry_cranial_m = 0.001;
  difference.diameter_from_m = 0.0055;
  difference.diameter_to_m = 0.006;
  difference.length_from_m = difference.length_to_m = 0.040;
  session.levels[0].screws[1].planned_in_surgery = difference;
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
  SessionRecord session = cut_session();
  RecordedRegistration& registration = session.registrations[0];
  registration.predicted_tre_m = 0.0006;
  registration.registration_only = false;
  session.levels[0].screws[0].at_depth->clearance_95_m = 0.0012;
  EXPECT_THAT(session_page(session, "j"), Not(HasSubstr("registration only")));
  registration.registration_only = true;
  const std::string page = session_page(session, "j");
  EXPECT_THAT(page, HasSubstr("0.60 <small>registration only</small>"));
  EXPECT_THAT(page, HasSubstr("1.20 <small>registration only</small>"));
  EXPECT_EQ(nlohmann::json::parse(session_json(session))["levels"][0]["registration_only"], true);
}

TEST(SessionReport, SaysFirstOfAllThatTheSessionWasCutOffAndWhen) {
  const std::string page = session_page(cut_session(), "a/session.orthonav.part");
  const std::size_t cut = page.find("This session was cut off");
  ASSERT_NE(cut, std::string::npos);
  EXPECT_LT(cut, page.find("<table"));
  EXPECT_THAT(page, HasSubstr("its last line is of 02:45.57 on the headset's clock, 64.6 s after "
                              "the first; one more line was torn and is not used"));
  EXPECT_THAT(page, HasSubstr("a/session.orthonav.part"));
  EXPECT_THAT(page, HasSubstr("&lt;spine&gt;"));
}

TEST(SessionReport, TellsWhatPositionsAreRelativeTo) {
  SessionRecord session = cut_session();
  EXPECT_THAT(session_page(session, "j"), HasSubstr("a frame that is not recorded"));
  session.patient_reference = false;
  EXPECT_THAT(session_page(session, "j"), HasSubstr("the headset\u2019s map"));
  session.patient_reference = true;
  EXPECT_THAT(session_page(session, "j"), HasSubstr("the patient reference"));
  EXPECT_EQ(nlohmann::json::parse(session_json(session))["patient_reference"], true);
}

TEST(SessionReport, CallsWhatTheJournalDoesNotHoldNotRecorded) {
  const std::string page = session_page(cut_session(), "j");
  EXPECT_THAT(page, HasSubstr("not recorded"));
  EXPECT_THAT(page, HasSubstr(">1 of 2</td>"));
  EXPECT_THAT(page, HasSubstr(">recorded, 0.4 (taken back), <span class=bad>2.3</span></td>"));
  EXPECT_THAT(page, HasSubstr("not done"));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  const auto json = nlohmann::json::parse(session_json(cut_session()));
  for (const char* key : {"frames", "seed"}) {
    EXPECT_FALSE(json.contains(key)) << key;
  }
  for (const char* key : {"points", "predicted_tre_mm", "tre_mm", "digitization_s"}) {
    EXPECT_FALSE(json["levels"][0].contains(key)) << key;
  }
}

TEST(SessionReport, TellsHowEveryWireWasMeasuredKeptRedoneOrNot) {
  SessionRecord session = cut_session();
  RecordedScrew& left = session.levels[0].screws[0];
  RecordedScrew& right = session.levels[0].screws[1];
  EXPECT_THAT(session_page(session, "j"), Not(HasSubstr("not measured")));
  left.wire_asked = right.wire_asked = right.done = true;
  left.wire = RecordedWire{0.05, 0.01, 0.0011, 0.0006, false, true};
  left.redone = 1;
  const std::string page = session_page(session, "j");
  EXPECT_THAT(page,
              HasSubstr("<span class=bad>2.9 \u00b1 0.6\u00b0, 1.1 \u00b1 0.6 mm</span>, kept; "
                        "redone</td>"));
  EXPECT_THAT(page, HasSubstr(">not measured</td>"));
  const auto json = nlohmann::json::parse(session_json(session));
  const auto& screws = json["levels"][0]["screws"];
  EXPECT_NEAR(screws[0]["wire"]["angle_deg"].get<double>(), 2.8648, 1e-4);
  EXPECT_DOUBLE_EQ(screws[0]["wire"]["entry_sd_mm"], 0.6);
  EXPECT_EQ(screws[0]["wire"]["kept"], true);
  EXPECT_EQ(screws[0]["redone"], 1);
  EXPECT_EQ(screws[1]["wire"], "not measured");
  left.wire->within = true;
  EXPECT_THAT(session_page(session, "j"),
              HasSubstr(">2.9 \u00b1 0.6\u00b0, 1.1 \u00b1 0.6 mm; redone</td>"));
}

TEST(SessionReport, HasTheFiguresInTheKeysOfAReport) {
  const auto json = nlohmann::json::parse(session_json(cut_session()));
  EXPECT_EQ(json["completed"], false);
  EXPECT_THAT(json["why_not"].get<std::string>(), HasSubstr("The journal has no end"));
  EXPECT_EQ(json["session"]["cut"], true);
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
}

/// A real session, cut at every tenth of it and at every byte of its last two lines.
TEST(SessionReport, IsMadeOfAJournalThatWasCutAnywhere) {
  const std::string whole = orthonav::test::content_of(std::filesystem::path(ORTHONAV_SOURCE_DIR) /
                                                       "tests/data/session.orthonav");
  ASSERT_GT(whole.size(), 10'000U);
  std::vector<std::size_t> lengths;
  for (std::size_t tenth = 1; tenth < 10; ++tenth) {
    lengths.push_back(whole.size() * tenth / 10);
  }
  const std::size_t last = whole.rfind('\n', whole.size() - 2);
  for (std::size_t at = whole.rfind('\n', last - 1) + 1; at < whole.size(); ++at) {
    lengths.push_back(at);
  }
  ASSERT_GT(lengths.size(), 100U);
  for (const std::size_t length : lengths) {
    SCOPED_TRACE(length);
    const auto session = read_journal_text(whole.substr(0, length), "cut");
    ASSERT_TRUE(session.ok()) << session.error().message;
    // All but its last line end: whole without that end, the journal is.
    const bool is_whole = length + 1 == whole.size();
    EXPECT_EQ(session->cut, !is_whole);
    const auto lines = static_cast<std::size_t>(
        std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length), '\n'));
    EXPECT_GE(session->lines, lines);
    EXPECT_LE(session->lines, lines + 1);
    const std::string page = session_page(*session, "cut");
    EXPECT_EQ(page.find("This session was cut off") == std::string::npos, is_whole);
    EXPECT_FALSE(session_json(*session).empty());
  }
}

TEST(SessionReport, BeginsWithWhatWasPlacedAndItsWarnings) {
  SessionRecord session = cut_session();
  RecordedScrew& left = session.levels[0].screws[0];
  left.wire_asked = true;
  left.wire = RecordedWire{0.05, 0.01, 0.0011, 0.0006, false, true};
  left.at_depth->clearance_m = 0.0004;
  left.at_depth->clearance_95_m = -0.0012;
  const std::string page = session_page(session, "j");
  EXPECT_THAT(page, HasSubstr("This session was cut off: 1 of 2 screws placed; their true distance "
                              "from the plan is not known, 0 of 1 measured wire within the "
                              "limits.</h2>"));
  EXPECT_THAT(page, HasSubstr("<li>L4 left: the wire was measured 2.9° and 1.1 mm from the plan, "
                              "beyond a limit, and kept</li><li>L4 left: as tracked, a breach of "
                              "the cortex cannot be ruled out (95 % bound −1.2 mm)</li>"));
  session.has_plan = false;
  EXPECT_THAT(session_page(session, "j"), HasSubstr("cut off: 1 screw placed;"));
}

TEST(SessionReport, TellsOfASessionThatEnded) {
  SessionRecord session = cut_session();
  session.cut = session.last_line_torn = false;
  EXPECT_THAT(session_page(session, "j"), HasSubstr("Operation completed"));
  EXPECT_EQ(nlohmann::json::parse(session_json(session))["completed"], true);
  session.reason = "stopped by SIGTERM, ended at rod";
  EXPECT_THAT(session_page(session, "j"), HasSubstr("Operation incomplete"));
  EXPECT_THAT(session_page(session, "j"), HasSubstr("; stopped by SIGTERM, ended at rod."));
  const SessionRecord header_alone;
  EXPECT_THAT(ending_of(header_alone), HasSubstr("no line after its first"));
}

}  // namespace
}  // namespace orthonav::engine
