#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/case/tool_file.h"
#include "tests/support/tag_body_scene.h"
#include "tests/tools/command_line.h"
#include "tests/tools/tag_recording.h"

namespace orthonav::test::calibrate_tool_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Rendered corners have errors of 0.03 px, the same in similar pairs; measured 0.03 mm, 0.05°.
constexpr double kPlaceM = 0.0001;
constexpr double kRotation_rad = 0.003;
constexpr int kPairs = 40;

/// A tag of the scene turned on its face, counter-clockwise.
struct Rotated {
  std::size_t tag = 0;
  int quarters = 0;
};

/// The prism turning, optionally without one of its tags, or with one that was glued on rotated.
void record_prism(const std::string& folder, int count = kPairs, std::size_t without = 99,
                  Rotated rotated = {}) {
  const TagBodyScene scene = prism();
  std::vector<std::vector<PlacedTag>> pairs;
  for (const auto& rig_from_marker : turning(count)) {
    pairs.emplace_back();
    for (std::size_t i = 0; i < scene.tags.size(); ++i) {
      if (i == without) {
        continue;
      }
      const double rotation_rad = i == rotated.tag ? rotated.quarters * std::numbers::pi / 2 : 0.0;
      const auto rig_from_tag = rig_from_marker * scene.marker_from_tag[i] *
                                Transform<Tag, Tag>{rotation_from_vector({0, 0, rotation_rad}), {}};
      pairs.back().push_back({scene.tags[i].family,
                              scene.tags[i].id,
                              scene.tags[i].size_m,
                              {rig_from_tag.rotation(), rig_from_tag.translation()}});
    }
  }
  record(folder, scene.calibration, pairs);
}

void expect_prism(const nav::ToolGeometry& tool) {
  const TagBodyScene scene = prism();
  EXPECT_EQ(tool.marker.id, 3);
  ASSERT_EQ(tool.more_markers.size(), 2u);
  for (std::size_t i = 1; i < 3; ++i) {
    const nav::AttachedMarker& more = tool.more_markers[i - 1];
    EXPECT_EQ(more.definition.id, scene.tags[i].id);
    EXPECT_DOUBLE_EQ(more.definition.size_m, 0.04);
    EXPECT_LT((more.marker_from_tag.translation() - scene.marker_from_tag[i].translation()).norm(),
              kPlaceM);
    EXPECT_LT(
        rotation_angle_rad(more.marker_from_tag.rotation(), scene.marker_from_tag[i].rotation()),
        kRotation_rad);
  }
}

TEST(CalibrateTool, FindsWhereTheTagsLieAndWritesATool) {
  const ScratchFolder folder;
  const std::string recording = folder.file("recording");
  record_prism(recording);
  const std::string out = folder.file("tools.json");
  const Called called = orthonav({"calibrate", "tool", recording, "--family", "tag36h11", "--ids",
                                  "3,4,5", "--size-mm", "40", "--out", out, "--json"});
  ASSERT_EQ(called.code, 0) << called.err;
  const auto tools = engine::load_tools(out);
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  ASSERT_EQ(tools->size(), 1u);
  EXPECT_EQ(tools->front().role, nav::ToolRole::kReference);
  expect_prism(tools->front());
  const auto json = nlohmann::json::parse(called.out);
  EXPECT_EQ(json["pairs"], kPairs);
  EXPECT_LT(json["rms_px"], 0.08);
  EXPECT_EQ(json["tags"].size(), 3u);
  EXPECT_NEAR(json["tags"][2]["measured_size_mm"], 40.0, 0.4);
  EXPECT_LT(json["tags"][1]["sigma_mm"], 0.1);
  EXPECT_NE(json["verdict"], "fail");

  // Into a file that already has the tool: everything else stays.
  const std::string own = folder.with("own.json", R"({"tools": [
    {"name": "pointer", "role": "pointer", "serial": 4, "axis": [0, 1, 0],
     "marker": {"family": "tag36h11", "id": 3, "size_mm": 40}, "tip_mm": [0, -150, 0]}]})");
  const Called plain = orthonav({"calibrate", "tool", recording, "--ids", "3-5", "--size-mm",
                                 "40,40,40", "--tools", own, "--tool", "pointer", "--out", own});
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_THAT(plain.out, AllOf(HasSubstr("tag36h11 id 5: at "), HasSubstr("residual 0.")));
  const auto changed = engine::load_tools(own);
  ASSERT_TRUE(changed.ok()) << changed.error().message;
  expect_prism(changed->front());
  EXPECT_EQ(changed->front().tip_in_marker.v, (Vec3{0, -0.15, 0}));
  EXPECT_THAT(content_of(own), HasSubstr("\"serial\": 4"));
}

/// The prism as its designer describes it.
std::string described_prism() {
  const TagBodyScene scene = prism();
  nav::ToolGeometry tool;
  tool.name = "reference";
  tool.role = nav::ToolRole::kReference;
  tool.marker = scene.tags[0];
  for (std::size_t i = 1; i < scene.tags.size(); ++i) {
    tool.more_markers.push_back({scene.tags[i], scene.marker_from_tag[i]});
  }
  return engine::tools_text({tool});
}

Called calibrated_against(const std::string& own, const std::string& recording,
                          const std::string& out) {
  return orthonav({"calibrate", "tool", recording, "--ids", "3-5", "--size-mm", "40", "--tools",
                   own, "--tool", "reference", "--out", out, "--json"});
}

TEST(CalibrateTool, RefusesATagThatIsMountedTurnedAndSaysWhichWay) {
  const ScratchFolder folder;
  const std::string own = folder.with("own.json", described_prism());
  const std::string out = folder.file("out.json");
  struct Case {
    Rotated rotated;
    std::string expected;
  };
  const std::vector<Case> cases = {
      {{2, 1}, "tag tag36h11 id 5 is mounted turned by 90° counter-clockwise"},
      {{2, 2}, "tag tag36h11 id 5 is mounted turned by 180°"},
      {{2, 3}, "tag tag36h11 id 5 is mounted turned by 90° clockwise"},
  };
  for (const Case& c : cases) {
    const std::string recording = folder.file("recording");
    std::filesystem::remove_all(recording);
    record_prism(recording, 20, 99, c.rotated);
    const Called called = calibrated_against(own, recording, out);
    EXPECT_EQ(called.code, 1) << c.expected;
    EXPECT_THAT(called.err, HasSubstr("refused: tool calibration: " + c.expected +
                                      ", seen from the front, against " + own + "; mount it"));
    EXPECT_EQ(nlohmann::json::parse(called.out)["verdict"], "fail");
    EXPECT_THAT(folder.names(), ElementsAre("own.json", "recording"));
  }
  // As described: the poses are measured, and the file says so.
  const std::string recording = folder.file("upright");
  record_prism(recording, 20);
  const Called upright = calibrated_against(own, recording, out);
  ASSERT_EQ(upright.code, 0) << upright.err;
  expect_prism(engine::load_tools(out)->front());
}

TEST(CalibrateTool, RefusesInOneLineAndWritesNothing) {
  const ScratchFolder folder;
  const std::string recording = folder.file("recording");
  record_prism(recording, 30, 2);
  const std::string few = folder.file("few");
  record_prism(few, 4, 2);
  const std::string out = folder.file("tools.json");
  const auto called = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {"calibrate", "tool", few, "--out", out};
    all.insert(all.end(), more.begin(), more.end());
    return orthonav(all);
  };
  const Called apart = orthonav({"calibrate", "tool", recording, "--out", out, "--ids", "3,4,5",
                                 "--size-mm", "40", "--json"});
  EXPECT_EQ(apart.code, 1);
  EXPECT_THAT(apart.err,
              AllOf(HasSubstr("refused: tool calibration: tag tag36h11 id 5 (seen in 0 pairs)"),
                    HasSubstr("; tag tag36h11 id 5 was never seen, only tag36h11 id 3, tag36h11 "
                              "id 4")));
  EXPECT_EQ(nlohmann::json::parse(apart.out)["verdict"], "fail");
  const Called wrong = called({"--ids", "3,4", "--size-mm", "30"});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("edges measure 4"), HasSubstr("given are 30.00 mm")));

  const std::string tools = folder.with("own.json", R"({"tools": [{"name": "a", "role": "pointer",
    "marker": {"family": "tag36h11", "id": 7, "size_mm": 40}, "tip_mm": [0, 0, 0]}]})");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--ids", "3,4", "--size-mm", "40,30,20"}, "3 sizes for 2 tags"},
      {{"--ids", "3,4", "--size-mm", "4000"}, "5-200 mm"},
      {{"--ids", "3,x", "--size-mm", "40"}, "--ids"},
      {{"--ids", "3,4", "--size-mm", "40", "--family", "tag99h1"}, "tag99h1"},
      {{"--ids", "3,4", "--size-mm", "40", "--tools", tools, "--tool", "a"}, "is tag36h11 id 7"},
      {{"--ids", "3,4", "--size-mm", "40", "--tools", tools, "--tool", "b"}, "no tool is named"},
      {{"--ids", "3,4", "--size-mm", "40", "--role", "hook"}, "--role"},
      {{"--ids", "3,4"}, "--size-mm"}};
  for (const auto& [more, what] : cases) {
    const Called bad = called(more);
    EXPECT_EQ(bad.code, 2) << what;
    EXPECT_THAT(bad.err, HasSubstr(what));
    EXPECT_EQ(std::count(bad.err.begin(), bad.err.end(), '\n'), 1) << bad.err;
    EXPECT_THAT(bad.out, IsEmpty());
  }
  EXPECT_EQ(called({"--ids", "3", "--size-mm", "40"}).code, 1) << "one tag is no body";
  EXPECT_THAT(folder.names(), ElementsAre("few", "own.json", "recording"));
}

}  // namespace
}  // namespace orthonav::test::calibrate_tool_test
