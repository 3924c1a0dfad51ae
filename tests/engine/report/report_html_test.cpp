#include "engine/report/report_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/report/base64.h"

namespace orthonav::engine {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kReport = R"({"method":"paper","seed":7,"case":"phantom <x>","levels":[
 {"label":"L4","accepted":true,"attempts":1,"rmse_mm":1.5,"tre_mm":0.9,"points":1800,
  "digitization_s":118.0,"screws":[{"side":"left","angle_error_deg":2.5,"entry_error_mm":2.0},
  {"side":"right","angle_error_deg":3.5,"entry_error_mm":3.0}]}],
 "rod":{"length_mm":42.5},"frames":{"displayed":10,"median_ms":33.3,"p99_ms":33.4}})";

TEST(Base64, FollowsTheStandard) {
  const auto of = [](std::string text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(ReportHtml, ShowsTheFiguresOfTheRunBesideThePapers) {
  const auto html = report_html({.report_json = kReport});
  ASSERT_TRUE(html.ok()) << html.error().message;
  EXPECT_THAT(*html, HasSubstr("3.38 ± 1.73"));
  EXPECT_THAT(*html, HasSubstr("3.00 ± 0.71"));  // mean and SD of 2.5 and 3.5
  EXPECT_THAT(*html, HasSubstr("phantom &lt;x&gt;"));
  EXPECT_THAT(*html, HasSubstr("42.5 mm"));
}

TEST(ReportHtml, TellsHowEveryWireWasMeasured) {
  const auto page = [](const std::string& of_screw) {
    return report_html({.report_json = R"({"levels":[{"label":"L4","screws":[{"side":"left")" +
                                       of_screw + "}]}]}"})
        .value();
  };
  constexpr const char* kWire =
      R"("wire":{"angle_deg":2.86,"angle_sd_deg":0.91,"entry_mm":1.1,"entry_sd_mm":0.6,"kept":)";
  EXPECT_THAT(page(std::string(",") + kWire + R"(true},"redone":1)"),
              HasSubstr(">2.9 ± 0.9°, 1.1 ± 0.6 mm, kept; redone</td>"));
  EXPECT_THAT(page(std::string(",") + kWire + R"(false},"redone":0)"),
              HasSubstr(">2.9 ± 0.9°, 1.1 ± 0.6 mm</td>"));
  EXPECT_THAT(page(R"(,"wire":"not measured")"), HasSubstr(">not measured</td>"));
  EXPECT_THAT(page(""), Not(HasSubstr("not measured")));
}

TEST(ReportHtml, TellsALevelThatWasRefusedFromOneThatWasNeverReached) {
  const auto page = [](const std::string& level) {
    return report_html({.report_json = R"({"levels":[{"label":"L4",)" + level + "}]}"}).value();
  };
  EXPECT_THAT(page(R"("accepted":false,"attempts":0)"), HasSubstr("not registered"));
  EXPECT_THAT(page(R"("accepted":false,"attempts":0)"), Not(HasSubstr("refused")));
  EXPECT_THAT(page(R"("accepted":false,"attempts":2)"), HasSubstr(">refused</span>"));
  EXPECT_THAT(page(R"("accepted":true,"attempts":1)"), HasSubstr(">accepted</span>"));
}

TEST(ReportHtml, LoadsNothingFromOutside) {
  ReportContent content{.report_json = kReport, .video = "operation.mp4"};
  content.pictures.push_back({"step", "what", {1, 2, 3}});
  content.plots.push_back({"</script><b>", "x", "y", {{"c", {0, 1}, {1, 2}}}, {{1.0, "l"}}});
  const auto html = report_html(content);
  ASSERT_TRUE(html.ok());
  EXPECT_THAT(*html, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(*html, Not(HasSubstr("</script><b>")));
  EXPECT_THAT(*html, HasSubstr("data:image/png;base64,AQID"));
}

/// Where the sections begin, in the order of `ids`.
std::vector<std::size_t> places_of(const std::string& html, const std::vector<std::string>& ids) {
  std::vector<std::size_t> places;
  for (const std::string& id : ids) {
    places.push_back(html.find(id));
  }
  return places;
}

ReportContent whole_content() {
  ReportContent content{.report_json = kReport, .date = "2026-11-25 10:04 UTC"};
  content.video = "operation.mp4";
  content.poster = {'p', 'o', 's'};
  content.pictures.push_back({"guide L4 left", "what", {1, 2, 3}});
  content.plots.push_back({"angle",
                           "s",
                           "°",
                           {{"L4 left", {0, 1, 2, 3}, {71.3, 6.5, 6.0, 1.0}}},
                           {{2.0, "good below 2.0°"}, {5.0, "poor above 5.0°"}},
                           6.0});
  content.timings.push_back({"tracking", {}});
  content.timings.back().ms.add(1.0);
  content.notes = {"a note"};
  return content;
}

TEST(ReportHtml, BeginsWithWhatASurgeonAsksAndEndsWithTiming) {
  const std::string html = report_html(whole_content()).value();
  const auto places =
      places_of(html, {"2026-11-25 10:04 UTC", "id=verdict", "id=film", "id=screws", "id=levels",
                       "id=rods", "id=steps", "id=paper", "id=plots", "id=timing", "id=notes"});
  EXPECT_THAT(places, Not(Contains(std::string::npos)));
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end())) << ::testing::PrintToString(places);
}

TEST(ReportHtml, FoldsWhatIsNotTheAnswer) {
  const std::string html = report_html(whole_content()).value();
  for (const char* shown : {"<section id=verdict", "<section id=film", "<section id=screws"}) {
    EXPECT_THAT(html, HasSubstr(shown));
  }
  for (const char* kept : {"<details id=levels><summary><h2>Registration</h2></summary>",
                           "<details id=rods", "<details id=plots", "<details id=notes"}) {
    EXPECT_THAT(html, HasSubstr(kept));
  }
}

TEST(ReportHtml, CallsWhatStandsInTheBoneByItsName) {
  const auto column = [](const std::string& instrument) {
    return report_html(
               {.report_json = R"({"instrument":")" + instrument +
                               R"(","levels":[{"label":"L4","screws":[{"side":"left"}]}]})"})
        .value();
  };
  EXPECT_THAT(column("sleeved drill"),
              AllOf(HasSubstr("drill as measured in place"), Not(HasSubstr("wire"))));
  EXPECT_THAT(column("wire"), HasSubstr("wire as measured in place"));
}

TEST(ReportHtml, OfRodsAloneIsAboutRodsAndClaimsNoScrew) {
  constexpr const char* kRods =
      R"({"completed":true,"seed":1,"levels":[],"rod":{"sides":[{"side":"left","heads":3,
       "length_mm":80.0,"length_error_mm":-0.34,"head_error_mm":0.9,"time_s":21.4,
       "cut_length_mm":92.3,"seat_by_pointer_mm":-3.0,
       "instructions":[{"arc_length_mm":45.2,"roll_deg":0,"angle_deg":12.1,"set_deg":15.3}]},
       {"side":"right","heads":2,"length_mm":40.0,"length_error_mm":0.1,
       "no_instructions":"direction to the bone is 20° off the rod"}]}})";
  const std::string html = report_html({.report_json = kRods}).value();
  EXPECT_THAT(html, HasSubstr("Operation completed: 2 rods templated; their lengths within 0.3 mm, "
                              "against the simulation\u2019s truth, without a registration."));
  EXPECT_THAT(html, HasSubstr("in 21 s"));
  EXPECT_THAT(html, HasSubstr("Cut to <b>92.3 mm</b>, 1 bend."));
  EXPECT_THAT(html, HasSubstr(">15.3</td>"));
  EXPECT_THAT(html, HasSubstr("taken to lie 3.0 mm above the touched places"));
  EXPECT_THAT(html, HasSubstr("No instructions to bend it: direction to the bone is 20°"));
  for (const char* section : {"id=screws", "id=levels", "id=paper", "id=plots"}) {
    EXPECT_THAT(html, Not(HasSubstr(section)));
    EXPECT_THAT(report_html(whole_content()).value(), HasSubstr(section)) << "control";
  }
}

TEST(ReportHtml, HasTheDateThatItIsToldAndReadsNoClock) {
  ReportContent content = whole_content();
  const std::string html = report_html(content).value();
  EXPECT_TRUE(report_html(content).value() == html) << "the same content, the same bytes";
  content.date.clear();
  EXPECT_THAT(report_html(content).value(),
              AllOf(HasSubstr("date <b>not recorded</b>"), Not(HasSubstr("2026"))));
}

TEST(ReportHtml, ShowsAPosterWhereThereIsAFilm) {
  ReportContent content = whole_content();
  EXPECT_THAT(report_html(content).value(),
              HasSubstr("src=\"operation.mp4\" poster=\"data:image/png;base64,cG9z\""));
  content.poster.clear();
  EXPECT_THAT(report_html(content).value(),
              AllOf(HasSubstr("src=\"operation.mp4\"></video>"), Not(HasSubstr("poster="))));
  content.video.clear();
  EXPECT_THAT(report_html(content).value(), Not(HasSubstr("<video")));
}

TEST(ReportHtml, MarksWhatLiesAboveThePlotsAxisAndKeepsWhatItWas) {
  const std::string html = report_html(whole_content()).value();
  EXPECT_THAT(html, HasSubstr(R"({"was":71.3,"x":0.0,"y":6.0},{"was":6.5,"x":1.0,"y":6.0},)"
                              R"({"x":2.0,"y":6.0},{"x":3.0,"y":1.0})"));
  EXPECT_THAT(html,
              HasSubstr("angle: above the axis (triangles at its edge) L4 left up to 71.3°."));
  EXPECT_THAT(html, AllOf(HasSubstr(R"({"name":"good below 2.0\u00b0","y":2.0})"),
                          HasSubstr(R"({"name":"poor above 5.0\u00b0","y":5.0})")));
  ReportContent open = whole_content();
  open.plots[0].y_max = 0.0;
  EXPECT_THAT(report_html(open).value(),
              AllOf(Not(HasSubstr("\"was\"")), Not(HasSubstr("above the axis (")),
                    HasSubstr(R"({"x":0.0,"y":71.3})")));
}

TEST(ReportHtml, EscapesEveryTextThatItIsTold) {
  constexpr const char* kHostile = "</script><img src=x onerror=alert(1)>\"'&";
  const std::string in_json = nlohmann::json(kHostile).dump();
  ReportContent content = whole_content();
  content.report_json = R"({"seed":1,"case":)" + in_json + R"(,"method":)" + in_json +
                        R"(,"completed":false,"why_not":)" + in_json + R"(,"levels":[{"label":)" +
                        in_json + R"(,"attempts":1,"screws":[{"side":)" + in_json +
                        R"(,"angle_error_deg":9.0,"clearance_mm":-1.0,"grade":)" + in_json +
                        R"(,"planned":{"accepted_breach":)" + in_json + R"(,"grade":)" + in_json +
                        R"(},"planned_in_surgery":{"text":)" + in_json + R"(},"wire":)" + in_json +
                        R"(}]}],"rod":{"sides":[{"side":)" + in_json + "}]}}";
  content.date = content.video = kHostile;
  content.pictures[0].title = content.pictures[0].caption = kHostile;
  content.plots[0].title = content.plots[0].curves[0].name = content.plots[0].y_axis = kHostile;
  content.plots[0].lines[0].name = content.timings[0].name = content.notes[0] = kHostile;
  const auto html = report_html(content);
  ASSERT_TRUE(html.ok()) << html.error().message;
  EXPECT_THAT(*html, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(*html, HasSubstr("&lt;img src=x onerror=alert(1)&gt;&quot;"));
}

TEST(ReportHtml, NamesTheColumnInEveryCellForNarrowScreens) {
  const std::string html = report_html({.report_json = kReport}).value();
  EXPECT_THAT(html, HasSubstr("<td data-label=\"angle error [°]\">2.5</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=bad data-label=\"entry error [mm]\">3.0</td>"));
}

TEST(ReportHtml, SaysWhatWasAnInputAndHowManyWereMeasured) {
  const std::string html = report_html({.report_json = kReport}).value();
  EXPECT_THAT(html, HasSubstr(">2 screws</td>"));
  EXPECT_THAT(html, HasSubstr(">1 level</td>"));
  EXPECT_THAT(html, HasSubstr(">an input: how the scripted surgeon strokes</td>"));
  // A real headset has no seed, and its surgeon's strokes are not an input.
  EXPECT_THAT(report_html({.report_json = R"({"levels":[{"label":"L4","points":9}]})"}).value(),
              Not(HasSubstr("an input")));
}

TEST(ReportHtml, SetsAnotherRunBesideThisOne) {
  ReportContent content{.report_json = kReport};
  EXPECT_THAT(report_html(content).value(), Not(HasSubstr("Beside it")));
  content.beside_json = R"({"method":"best","levels":[{"rmse_mm":1.11,"screws":[]}]})";
  content.beside_page = "../best/report.html";
  const std::string html = report_html(content).value();
  EXPECT_THAT(html, HasSubstr("<td data-label=\"method best\">1.11</td>"));
  EXPECT_THAT(html, HasSubstr("<a href=\"../best/report.html\">the run with method best</a>"));
}

TEST(ReportHtml, RefusesFiguresThatAreNoReport) {
  EXPECT_FALSE(report_html({.report_json = "{}"}).ok());
  EXPECT_FALSE(report_html({.report_json = "not json"}).ok());
}

}  // namespace
}  // namespace orthonav::engine
