#include "tools/orthonav/dashboard/dashboard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/io/image_file.h"
#include "tests/support/browser.h"
#include "tests/support/language_in_use.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/tag_scene.h"
#include "tests/support/temporary_folder.h"
#include "tools/orthonav/dashboard/dashboard_state.h"

namespace orthonav::tools::dashboard_test {
namespace {

using nlohmann::json;
using test::guide_at;
using ::testing::HasSubstr;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};

json state_of(test::ScriptedOperation& s, const engine::Guidance& g) {
  return json::parse(dashboard_state(s.session(), g, {0.05, 0.09}, 1.5, {"a", "b"}));
}

TEST(DashboardState, SaysStepToolsAndLevelsAndNoNumberWhileNothingIsGuided) {
  test::ScriptedOperation s;
  const json state = state_of(s, s.pair());
  EXPECT_EQ(state["step"], "setup");
  EXPECT_EQ(state["time_s"], 1.5);
  EXPECT_EQ(state["frame_of_reference"], "headset's map");
  EXPECT_TRUE(state["guidance"].is_null());
  ASSERT_EQ(state["levels"].size(), 2u);
  EXPECT_EQ(state["levels"][0]["label"], "L4");
  EXPECT_EQ(state["levels"][0]["registered"], false);
  EXPECT_EQ(state["tools"][1]["status"], "lost");
  EXPECT_EQ(state["messages"][1], "b");
}

TEST(DashboardState, HasTheNumbersAsTheSurgeonReadsThemAndOnlyWhileTheToolIsMeasured) {
  test::ScriptedOperation s;
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.1);
  const json state = state_of(s, s.pair());
  ASSERT_TRUE(state["guidance"].is_object()) << state;
  EXPECT_EQ(state["guidance"]["level"], "L4");
  EXPECT_EQ(state["guidance"]["angle"], "5.7°");
  EXPECT_EQ(state["guidance"]["grade"], "poor") << "5.7 degrees, limit 5.2";
  EXPECT_NEAR(state["guidance"]["to_entry_mm"].get<double>(), 10.0, 0.1);
  EXPECT_EQ(state["levels"][0]["accepted"], true);
  EXPECT_EQ(state["tools"][1]["status"], "measured");
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const json predicted = state_of(s, s.pair());
  EXPECT_TRUE(predicted["guidance"].is_null());
  EXPECT_EQ(predicted["tools"][1]["status"], "predicted");
}

class DashboardPage : public ::testing::Test {
 protected:
  void SetUp() override {
    const Status opened = dashboard_.open({.at = "0"});
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    browser_ = std::make_unique<httplib::Client>("127.0.0.1", dashboard_.port());
  }
  Dashboard dashboard_;
  std::unique_ptr<httplib::Client> browser_;
};

TEST_F(DashboardPage, IsOnePageThatLoadsNothingFromElsewhere) {
  const auto page = browser_->Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, HasSubstr("<title>orthonav</title>"));
  EXPECT_EQ(page->body.find("http"), std::string::npos) << "no other address is named";
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'self'"));
}

TEST_F(DashboardPage, SaysThatNothingCameYet) {
  const auto state = browser_->Get("/state");
  ASSERT_TRUE(state);
  EXPECT_TRUE(json::parse(state->body)["now"].is_null());
  EXPECT_EQ(browser_->Get("/view.png")->status, 404);
  EXPECT_EQ(browser_->Get("/else")->status, 404);
}

RgbaImage red_picture() {
  RgbaImage picture;
  picture.width_px = 4;
  picture.height_px = 2;
  for (int i = 0; i < 8; ++i) {
    picture.pixels.insert(picture.pixels.end(), {255, 0, 0, 255});
  }
  return picture;
}

TEST_F(DashboardPage, ShowsThePictureThatItIsGivenAndSaysWhatItIs) {
  const auto view = [this] { return json::parse(browser_->Get("/state")->body)["view"]; };
  EXPECT_EQ(view(), "no picture");
  EXPECT_FALSE(dashboard_.looked_at()) << "nobody asked for it yet";
  dashboard_.show(red_picture(), "what the \"surgeon\" sees");
  EXPECT_EQ(view(), "what the \"surgeon\" sees");
  const auto picture = browser_->Get("/view.png");
  ASSERT_EQ(picture->status, 200);
  EXPECT_EQ(picture->body, engine::png_bytes(red_picture()).value());
  EXPECT_TRUE(dashboard_.looked_at());
}

TEST_F(DashboardPage, ShowsTheCameraUprightThoughItLiesOnItsSide) {
  const StereoCalibration cameras = test::test_calibration();
  test::ScriptedOperation s;
  dashboard_.watch(s.session(), {0.05, 0.09});
  dashboard_.look_through(cameras);
  StereoFrame frame;
  frame.left = GreyImage(640, 480);
  const Mat3 rig_from_camera = cameras.left_from_rig.rotation().transposed();
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const auto plane = cameras.left.unproject({x + 0.5, y + 0.5});
      const bool above = plane && (rig_from_camera * Vec3{plane->x, plane->y, 1.0}).y > 0.0;
      frame.left.pixels[static_cast<std::size_t>(640 * y + x)] = above ? 240 : 120;
    }
  }
  dashboard_.pair_came(frame);
  dashboard_.stepped(frame, {}, s.pair());
  const test::TemporaryFolder folder;
  std::ofstream(folder / "view.png") << browser_->Get("/view.png")->body;
  const auto view = engine::read_png(folder / "view.png");
  ASSERT_TRUE(view.ok()) << view.error().message;
  const auto grey_at = [&](double x, double y) {
    return int{view->pixels[4 * static_cast<std::size_t>(int(y * view->height_px) * view->width_px +
                                                         int(x * view->width_px))]};
  };
  for (const double x : {0.01, 0.5, 0.99}) {
    EXPECT_EQ(grey_at(x, 0.02), 240) << x;
    EXPECT_EQ(grey_at(x, 0.98), 120) << x;
  }
}

TEST_F(DashboardPage, SaysWhatHangsUntilItGoesOn) {
  const auto stalled = [this] { return json::parse(browser_->Get("/state")->body)["stalled"]; };
  test::ScriptedOperation s;
  dashboard_.watch(s.session(), {0.05, 0.09});
  EXPECT_EQ(stalled(), "");
  dashboard_.part_stalled(engine::Part::kTracker);
  EXPECT_EQ(stalled(), "tracker stalled: nothing is guided");
  StereoFrame frame;
  dashboard_.pair_came(frame);
  dashboard_.stepped(frame, {}, s.pair());
  EXPECT_EQ(stalled(), "");
}

TEST_F(DashboardPage, SaysWhatTheSurgeonReadsInTheirLanguage) {
  test::ScriptedOperation s;
  dashboard_.watch(s.session(), {0.05, 0.09});
  const test::LanguageInUse in_use(std::vector<Translation::Entry>{
      {"setup", "Vorbereitung"},
      {"tracker stalled: nothing is guided", "Tracking steht: keine Navigation"}});
  StereoFrame frame;
  dashboard_.pair_came(frame);
  dashboard_.stepped(frame, {}, s.pair());
  dashboard_.part_stalled(engine::Part::kTracker);
  const json page = json::parse(browser_->Get("/state")->body);
  EXPECT_EQ(page["now"]["step"], "Vorbereitung");
  EXPECT_EQ(page["stalled"], "Tracking steht: keine Navigation");
}

TEST_F(DashboardPage, AnswersThisMachinesPageAloneAndIsReadOnly) {
  EXPECT_EQ(browser_->Get("/state", {{"Host", "hospital.example"}})->status, 403);
  EXPECT_EQ(browser_->Get("/state", {{"Host", "localhost:80"}})->status, 200);
  EXPECT_EQ(browser_->Post("/state", "{}", "application/json")->status, 403);
  EXPECT_EQ(browser_->Delete("/state")->status, 403);
}

TEST_F(DashboardPage, IsRefusedAtAPortThatIsTaken) {
  Dashboard second;
  const Status opened = second.open({.at = std::to_string(dashboard_.port())});
  ASSERT_FALSE(opened.ok());
  EXPECT_THAT(opened.error().message, HasSubstr("the port cannot be had"));
}

TEST(DashboardToken, LetsInWhoBringsItAndNobodyElse) {
  const test::TemporaryFolder folder;
  Dashboard dashboard;
  const Status opened = dashboard.open({.at = "0", .token_file = folder.file("token")});
  ASSERT_TRUE(opened.ok()) << opened.error().message;
  httplib::Client browser("127.0.0.1", dashboard.port());
  for (const char* address : {"/", "/state", "/view.png", "/?token=", "/?token=0123456789abcdef"}) {
    const auto refused = browser.Get(address);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->status, 403) << address;
    EXPECT_FALSE(refused->has_header("Set-Cookie")) << address;
  }
  const std::string token = test::content_of(folder.file("token")).substr(0, 32);
  const auto first = browser.Get("/?token=" + token);
  ASSERT_EQ(first->status, 303);
  EXPECT_EQ(first->get_header_value("Location"), "/") << "the token leaves the address";
  const std::string cookie = first->get_header_value("Set-Cookie");
  EXPECT_THAT(cookie, HasSubstr("; HttpOnly; SameSite=Strict"));
  const httplib::Headers with_cookie = {{"Cookie", "a=b; " + cookie.substr(0, cookie.find(';'))}};
  EXPECT_EQ(browser.Get("/state", with_cookie)->status, 200);
  EXPECT_EQ(browser.Post("/state", with_cookie, "{}", "application/json")->status, 403);
  EXPECT_EQ(browser.Get("/state", {{"Cookie", "orthonav_token=" + token + "0"}})->status, 403);
}

/// In a real browser, if there is one, to test the page's script.
TEST_F(DashboardPage, ShowsTheOperationInABrowser) {
  if (!test::has_browser()) {
    GTEST_SKIP() << test::kNoBrowser;
  }
  test::ScriptedOperation s;
  s.accepts_first_level();
  s.says("next");
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.1);
  const engine::Guidance& guidance = s.pair();
  StereoFrame frame;
  frame.time = s.now();
  frame.left.width_px = 4;
  frame.left.height_px = 2;
  frame.left.pixels.assign(8, 128);
  dashboard_.watch(s.session(), {0.05, 0.09});
  dashboard_.pair_came(frame);
  dashboard_.stepped(frame, {}, guidance);
  // The browser may take seconds to start, and a picture that old is not served.
  std::jthread shows([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      dashboard_.show(red_picture(), "what the surgeon sees");
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  const std::string page =
      test::page_in_browser("http://127.0.0.1:" + std::to_string(dashboard_.port()) + "/", 900);
  shows.request_stop();
  ASSERT_THAT(page, HasSubstr("<h1 id=\"step\">guide L4 left</h1>")) << "the script ran";
  EXPECT_THAT(page, HasSubstr("<h2 id=\"screw\">Guidance L4 left</h2>"));
  EXPECT_THAT(page, HasSubstr("<div id=\"angle\" class=\"poor\">5.7°</div>"));
  EXPECT_THAT(page, HasSubstr("<h2 id=\"what\">what the surgeon sees</h2>"));
  EXPECT_THAT(page, HasSubstr("src=\"http://127.0.0.1:")) << "the view was loaded";
  EXPECT_THAT(page, HasSubstr("class=\"chip measured\""));
  EXPECT_THAT(page, HasSubstr("<td>unknown (registration only)</td>"))
      << "an error that has no bound is no number";
  // The browser takes a while to start, so the pair may be old by then; nothing else may be wrong.
  EXPECT_EQ(page.find("role=\"alert\">the program"), std::string::npos);
  EXPECT_EQ(page.find("role=\"alert\">this page cannot"), std::string::npos);
  EXPECT_THAT(page, HasSubstr("<li>"));
  EXPECT_EQ(page.find("<button"), std::string::npos) << "there is nothing to press";
}

}  // namespace
}  // namespace orthonav::tools::dashboard_test
