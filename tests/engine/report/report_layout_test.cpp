#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "engine/report/report_html.h"
#include "engine/report/session_report.h"
#include "tests/support/browser.h"
#include "tests/support/whole_log.h"

namespace orthonav::engine::report_layout_test {
namespace {

/// A page with everything, with the longest texts.
ReportContent full_content() {
  nlohmann::json screw = nlohmann::json::parse(R"({"side":"right","done":true,
    "angle_error_deg":7.5,"entry_error_mm":2.5,"clearance_mm":-1.25,"grade":"B","arc_mm":18.0,
    "towards":"medial","planned":{"diameter_mm":6.5,"length_mm":45.0,"clearance_mm":3.5,
    "clearance_95_mm":1.5,"grade_probability":{"A":0.5,"B":0.2,"C":0.2,"D":0.1},"grade":"A",
    "arc_mm":6.0,"towards":"posterior"},
    "planned_in_surgery":{"text":"entry moved 2.0 mm cranial, 6.0 x 40 mm instead of 5.5 x 40 mm"},
    "tracked":{"clearance_mm":-1.5,"clearance_95_mm":-4.0,
    "grade_probability":{"A":0.1,"B":0.5,"C":0.3,"D":0.1}},
    "executed":{"entry_mm":[-31.7,-34.6,-16.9],"direction":[-0.447,-0.890,-0.080],"depth_mm":9.1,
    "pairs":21},"wire":{"angle_deg":4.2,"angle_sd_deg":0.8,"entry_mm":2.4,"entry_sd_mm":1.1,
    "within":false,"kept":true},"redone":1})");
  ReportContent content;
  content.report_json =
      nlohmann::json{{"seed", 18446744073709551615ULL},
                     {"case", "a case of a long name"},
                     {"method", "best"},
                     {"completed", true},
                     {"levels",
                      {{{"label", "L4"},
                        {"accepted", true},
                        {"attempts", 2},
                        {"predicted_tre_mm", 2.0},
                        {"registration_only", true},
                        {"screws", {screw, screw}}}}},
                     {"rod", {{"length_mm", 40.0}, {"sides", {{{"side", "left"}, {"heads", 2}}}}}},
                     {"calibration", {{"tags", {{{"tool", "reference"}}}}}}}
          .dump();
  content.plots.push_back(
      {"angle", "time [s]", "°", {{"L4 left", {0, 1}, {70, 1}}}, {{5.0, "red"}}, 6.0});
  content.timings.push_back({"draw the surgeon's view (room and holograms)", {}});
  content.timings.back().ms.add(1.0);
  const OperatedLevel level = plan_operation(phantom({"L4"}), {"L4"}).value().levels.front();
  RegisteredLevel registered;
  registered.label = "L4";
  registered.method = "best";
  registered.model = level.model;
  registered.screws = level.screws;
  registered.registration.noise_m = 0.001;
  registered.registration.uncertainty =
      nav::PoseUncertainty{{}, std::array<double, 36>{1e-6, 0, 0, 0, 0, 0, 0, 1e-6}};
  for (int i = 0; i < 12; ++i) {
    const Point<World> place{level.model->reachable().vertices_m[static_cast<std::size_t>(i)]};
    registered.points.push_back(place);
    registered.check_points.push_back({place, -0.0004, true});
  }
  content.registrations.push_back(registered);
  return content;
}

/// A number of pixels of a page on a phone, as a browser lays it out; -1: it was not opened.
int on_a_phone_px(const std::string& page, const std::string& what) {
  const std::string px = test::on_a_phone(page, "d.documentElement." + what);
  return px == "?" ? -1 : std::stoi(px);
}
int width_on_a_phone(const std::string& page) { return on_a_phone_px(page, "scrollWidth"); }
int height_on_a_phone(const std::string& page) { return on_a_phone_px(page, "scrollHeight"); }

TEST(ReportLayout, FitsAPhone) {
  if (!test::has_browser()) {
    GTEST_SKIP() << test::kNoBrowser;
  }
  const auto report = report_html(full_content());
  ASSERT_TRUE(report.ok()) << report.error().message;
  const int report_px = width_on_a_phone(*report);
  EXPECT_GT(report_px, 0);
  EXPECT_LE(report_px, test::kPhone_px);
  const auto session =
      LoggedOperation::from(read_records(test::whole_log(), "log").value().records, "log");
  ASSERT_TRUE(session.ok());
  const int session_px = width_on_a_phone(session_page(*session, "operation.resume"));
  EXPECT_GT(session_px, 0);
  EXPECT_LE(session_px, test::kPhone_px);
  EXPECT_GT(width_on_a_phone("<!doctype html><p style='width:600px'>wide"), test::kPhone_px)
      << "a page that does not fit is seen";
}

TEST(ReportLayout, IsScrolledThroughOnAPhoneInTenScreens) {
  if (!test::has_browser()) {
    GTEST_SKIP() << test::kNoBrowser;
  }
  constexpr int kMax_px = 8000;
  ReportContent content = full_content();
  // An operation of four levels, as long as they get.
  nlohmann::json report = nlohmann::json::parse(content.report_json);
  for (int level = 1; level < 4; ++level) {
    report["levels"].push_back(report["levels"][0]);
    content.registrations.push_back(content.registrations[0]);
  }
  content.report_json = report.dump();
  const auto page = report_html(content);
  ASSERT_TRUE(page.ok()) << page.error().message;
  const int folded_px = height_on_a_phone(*page);
  EXPECT_GT(folded_px, 0);
  EXPECT_LE(folded_px, kMax_px);
  std::string unfolded = *page;
  for (std::size_t at = unfolded.find("<details"); at != std::string::npos;
       at = unfolded.find("<details", at + 1)) {
    unfolded.insert(at + std::string("<details").size(), " open");
  }
  EXPECT_GT(height_on_a_phone(unfolded), kMax_px) << "what is folded counts where it is not";
}

/// Every table of both pages: a row that is not a card would run off the screen or have to be
/// zoomed.
TEST(ReportLayout, HasNoTableThatAPhoneHasToScroll) {
  if (!test::has_browser()) {
    GTEST_SKIP() << test::kNoBrowser;
  }
  const auto report = report_html(full_content());
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(test::too_wide_for_a_phone(*report), "");
}

}  // namespace
}  // namespace orthonav::engine::report_layout_test
