#include "engine/report/report_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/report/base64.h"

namespace orthonav::engine {
namespace {

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
              HasSubstr("<td>2.9 ± 0.9°, 1.1 ± 0.6 mm, kept; redone</td>"));
  EXPECT_THAT(page(std::string(",") + kWire + R"(false},"redone":0)"),
              HasSubstr("<td>2.9 ± 0.9°, 1.1 ± 0.6 mm</td>"));
  EXPECT_THAT(page(R"(,"wire":"not measured")"), HasSubstr("<td>not measured</td>"));
  EXPECT_THAT(page(""), Not(HasSubstr("not measured")));
}

TEST(ReportHtml, TellsALevelThatWasRefusedFromOneThatWasNeverReached) {
  const auto page = [](const std::string& level) {
    return report_html({.report_json = R"({"levels":[{"label":"L4",)" + level + "}]}"}).value();
  };
  EXPECT_THAT(page(R"("accepted":false,"attempts":0)"), HasSubstr("not reached"));
  EXPECT_THAT(page(R"("accepted":false,"attempts":0)"), Not(HasSubstr("refused")));
  EXPECT_THAT(page(R"("accepted":false,"attempts":2)"), HasSubstr(">refused</span>"));
  EXPECT_THAT(page(R"("accepted":true,"attempts":1)"), HasSubstr(">accepted</span>"));
}

TEST(ReportHtml, LoadsNothingFromOutside) {
  ReportContent content{.report_json = kReport, .video = "operation.mp4"};
  content.pictures.push_back({"step", "what", {1, 2, 3}});
  content.plots.push_back({"</script><b>", "x", "y", {{"c", {0, 1}, {1, 2}}}, 1.0});
  const auto html = report_html(content);
  ASSERT_TRUE(html.ok());
  EXPECT_THAT(*html, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(*html, Not(HasSubstr("</script><b>")));
  EXPECT_THAT(*html, HasSubstr("data:image/png;base64,AQID"));
}

TEST(ReportHtml, RefusesFiguresThatAreNoReport) {
  EXPECT_FALSE(report_html({.report_json = "{}"}).ok());
  EXPECT_FALSE(report_html({.report_json = "not json"}).ok());
}

}  // namespace
}  // namespace orthonav::engine
