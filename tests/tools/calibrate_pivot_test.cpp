#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/printed.h"
#include "engine/case/tool_file.h"
#include "tests/tools/command_line.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::calibrate_pivot_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The published method measures 0.6° of tilt for a 50 mm tag at 0.4 m: 0.8 mm at a tip 80 mm away,
// 60 pairs and turns of 20°. The photometric one measures 0.02°.
constexpr double kPaperTipM = 0.0012;
constexpr double kBestTipM = 0.0001;
const Vec3 kTip{0.004, -0.08, -0.003};
constexpr int kPairs = 60;

// A pointer with tag 3, tilted by `lean_rad` in all directions about its tip.
std::vector<std::vector<PlacedTag>> pivoting(double lean_rad, Vec3 slip_m = {}) {
  std::vector<std::vector<PlacedTag>> pairs;
  const Vec3 pivot_in_rig = (facing() * Point<Marker>{kTip}).v;
  for (int i = 0; i < kPairs; ++i) {
    const double around = 0.7 * i;
    const double lean = lean_rad * (0.6 + 0.4 * std::sin(1.3 * i));
    const Mat3 rotation = rotation_from_vector(
        {lean * std::cos(around), 0.5 * lean * std::sin(0.45 * i), lean * std::sin(around)});
    const Vec3 pivot = pivot_in_rig + (i >= kPairs / 2 ? slip_m : Vec3{});
    pairs.push_back({{"tag36h11", 3, 0.05, {rotation, pivot - rotation * kTip}}});
  }
  return pairs;
}

class CalibratePivot : public ::testing::Test {
 protected:
  void SetUp() override {
    tools_ = folder_.with("tools.json", R"({"owner": "us", "tools": [
      {"name": "pointer", "role": "pointer", "axis": [0, 1, 0],
       "marker": {"family": "tag36h11", "id": 3, "size_mm": 50}, "tip_mm": [0, -150, 0]},
      {"name": "guide", "role": "guide",
       "marker": {"family": "tag36h11", "id": 5, "size_mm": 70}, "tip_mm": [0, -160, 0]}]})");
  }
  Called pivot(const std::string& recording, std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"calibrate", "pivot",  recording, "--tools",
                                    tools_,      "--tool", "pointer"};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  }
  ScratchFolder folder_;
  std::string tools_;
};

TEST_F(CalibratePivot, FindsTheTipAndWritesItIntoTheTools) {
  const std::string recording = folder_.file("recording");
  record(recording, test_calibration(), pivoting(0.5));
  const std::string out = folder_.file("calibrated.json");
  const Called paper = pivot(recording, {"--json", "--out", out, "--method", "paper"});
  ASSERT_EQ(paper.code, 0) << paper.err;
  const auto by_paper = engine::load_tools(out);
  ASSERT_TRUE(by_paper.ok()) << by_paper.error().message;
  EXPECT_LT((by_paper->at(0).tip_in_marker.v - kTip).norm(), kPaperTipM);
  const Called called = pivot(recording, {"--json", "--out", out});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_EQ(json["method"], "best");
  EXPECT_EQ(json["pairs"], kPairs);
  // The most tilted poses are less exact than the others, whose scatter sets the limit.
  EXPECT_GE(json["inliers"], kPairs * 85 / 100);
  EXPECT_GT(json["spread_deg"], 10.0);
  EXPECT_NE(json["verdict"], "fail");
  const auto tools = engine::load_tools(out);
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  const Vec3 tip = tools->at(0).tip_in_marker.v;
  EXPECT_LT((tip - kTip).norm(), kBestTipM);
  EXPECT_LT((tip - kTip).norm(), 3.5 * json["tip_sigma_mm"].get<double>() * 1e-3);
  EXPECT_NEAR(json["tip_mm"][1], tip.y * 1e3, 1e-9);
  EXPECT_EQ(tools->at(1).tip_in_marker.v, (Vec3{0, -0.16, 0}));
  EXPECT_THAT(content_of(out), HasSubstr("\"owner\": \"us\""));

  const Called plain = pivot(recording, {"--out", tools_});
  EXPECT_THAT(plain.out, HasSubstr("pointer: tip "));
  EXPECT_EQ(content_of(tools_), content_of(out)) << "in place, and the same again";
}

/// The same movement as another tracker writes it, in mm.
std::string as_table(const std::string& heading, double lean_rad) {
  std::string text = heading;
  for (const auto& pair : pivoting(lean_rad)) {
    const auto& pose = pair.front().rig_from_marker;
    const Quaternion q = quaternion_from_rotation(pose.rotation());
    const Vec3 t = pose.translation() * 1e3;
    append_printed(text, "%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f\n", t.x, t.y, t.z, q.x, q.y, q.z, q.w);
  }
  return text;
}

TEST_F(CalibratePivot, TakesThePosesOfAnotherTracker) {
  const std::string poses = folder_.with("poses.csv", as_table("x,y,z,qx,qy,qz,qw\n", 0.5));
  const std::string tools = folder_.with("untagged.json", R"({"tools": [
      {"name": "stylus", "role": "pointer", "tip_mm": [0, -150, 0]}]})");
  const Called called = orthonav({"calibrate", "pivot", poses, "--units", "mm", "--tools", tools,
                                  "--tool", "stylus", "--out", tools, "--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_EQ(json["format"], "table");
  EXPECT_FALSE(json.contains("method"));
  EXPECT_EQ(json["poses"], kPairs);
  const auto changed = engine::load_tools(tools, engine::ToolTags::kOptional);
  ASSERT_TRUE(changed.ok()) << changed.error().message;
  EXPECT_LT((changed->at(0).tip_in_marker.v - kTip).norm(), 1e-8);

  const std::string bare = folder_.with("bare.csv", as_table("", 0.5));
  const Called plain =
      orthonav({"calibrate", "pivot", "--units", "mm", "--columns", "x,y,z,qx,qy,qz,qw", bare});
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_THAT(plain.out, HasSubstr("tip 4.000 -80.000 -3.000 mm"));
  EXPECT_THAT(plain.out, HasSubstr("60 of 60 poses agree"));

  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{poses}, "does not state its unit of length, give it (--units mm or --units m)"},
      {{bare, "--units", "mm"}, "7 columns without names"},
      {{poses, "--units", "inch"}, "--units"},
      {{folder_.file("none.csv")}, "none.csv: cannot be opened"},
      {{poses, "--units", "mm", "--out", tools}, "--tools is required"}};
  for (const auto& [more, what] : cases) {
    std::vector<std::string> all = {"calibrate", "pivot"};
    all.insert(all.end(), more.begin(), more.end());
    const Called refused = orthonav(all);
    EXPECT_EQ(refused.code, 2) << what;
    EXPECT_THAT(refused.err, HasSubstr(what));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
}

TEST_F(CalibratePivot, RefusesInOneLineAndWritesNothing) {
  const std::string still = folder_.file("still");
  record(still, test_calibration(), pivoting(0.05));
  const std::string slipped = folder_.file("slipped");
  record(slipped, test_calibration(), pivoting(0.5, {0.02, 0, 0.01}));
  const std::string out = folder_.file("out.json");
  const std::vector<std::pair<std::string, std::string>> cases = {{still, "turned by"},
                                                                  {slipped, "slip"}};
  for (const auto& [recording, why] : cases) {
    const Called called = pivot(recording, {"--json", "--out", out});
    EXPECT_EQ(called.code, 1) << called.out;
    EXPECT_THAT(called.err, HasSubstr("orthonav: refused: pivot calibration: "));
    EXPECT_THAT(called.err, HasSubstr(why));
    const auto json = nlohmann::json::parse(called.out);
    EXPECT_EQ(json["verdict"], "fail");
    EXPECT_THAT(json["reason"].get<std::string>(), HasSubstr(why));
    EXPECT_FALSE(json.contains("tip_mm"));
  }
  EXPECT_THAT(folder_.names(), ElementsAre("slipped", "still", "tools.json"));
}

TEST_F(CalibratePivot, RefusesBadInputInOneLine) {
  const std::string recording = folder_.file("recording");
  record(recording, test_calibration(), {pivoting(0.5).front()});
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--tool", "hook"}, "no tool is named 'hook' (there are: pointer, guide)"},
      {{"--tool", "pointer", "--method", "magic"}, "magic"},
      {{"--tool", "pointer", "--out", folder_.file("no/where.json")}, "no"},
      {{"--tool", "pointer", "--inlier-mm", "-1"}, "--inlier-mm"},
      {{}, "--tool is required"}};
  for (const auto& [more, what] : cases) {
    std::vector<std::string> all = {"calibrate", "pivot", recording, "--tools", tools_};
    all.insert(all.end(), more.begin(), more.end());
    const Called called = orthonav(all);
    EXPECT_EQ(called.code, 2) << what;
    EXPECT_THAT(called.err, HasSubstr(what));
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    EXPECT_THAT(called.out, IsEmpty());
  }
  const std::string other = folder_.with("other.json", R"({"tools": [{"name": "pointer",
    "role": "pointer", "marker": {"family": "tag36h11", "id": 7, "size_mm": 40},
    "tip_mm": [0, 0, 0]}]})");
  const Called unseen =
      orthonav({"calibrate", "pivot", recording, "--tools", other, "--tool", "pointer"});
  EXPECT_EQ(unseen.code, 2);
  EXPECT_THAT(unseen.err,
              HasSubstr("tag tag36h11 id 7 of 'pointer' was never seen, only tag36h11"));
  EXPECT_EQ(pivot(folder_.file("none")).code, 2);
  EXPECT_EQ(pivot(recording).code, 1) << "one pair is too few";
  EXPECT_EQ(orthonav({"calibrate"}).code, 2);
}

}  // namespace
}  // namespace orthonav::test::calibrate_pivot_test
