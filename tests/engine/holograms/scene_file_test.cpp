#include "engine/holograms/scene_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/holograms/scene_file_holograms.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;
using orthonav::test::content_of;
using ::testing::HasSubstr;

/// The example that docs/scene-files.md begins with.
json example() {
  const std::string page = content_of(ORTHONAV_SOURCE_DIR "/docs/scene-files.md");
  const std::size_t begin = page.find("```json\n") + 8;
  return json::parse(page.substr(begin, page.find("```", begin) - begin));
}

class SceneFiles : public ::testing::Test {
 protected:
  Result<SceneFile> loaded(const json& scene) {
    std::ofstream((folder_.path() / "scene.json").string()) << scene.dump();
    return load_scene((folder_.path() / "scene.json").string());
  }
  /// What is said about the example with one more hologram.
  std::string said_about(const char* hologram) {
    json scene = example();
    scene["holograms"].push_back(json::parse(hologram));
    const auto file = loaded(scene);
    return file.ok() ? "nothing" : file.error().message;
  }
  orthonav::test::TemporaryFolder folder_;
};

TEST_F(SceneFiles, TheExampleOfTheDocsIsDrawn) {
  const auto file = loaded(example());
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->eyes.size(), 2u);
  EXPECT_EQ(file->width_px, 1268);
  ASSERT_EQ(file->scene.meshes.size(), 2u) << "an entry, and a dot of the cross";
  EXPECT_EQ(file->scene.meshes[0].label, 301u);
  EXPECT_FLOAT_EQ(file->scene.meshes[0].world_from_model[3].x, 0.0165f) << "metres";
  ASSERT_EQ(file->scene.texts.size(), 3u);
  EXPECT_EQ(file->scene.texts[0].runs[0].text, "L4 left");
  EXPECT_EQ(file->scene.texts[1].runs[0].text, "3.4°");
  EXPECT_EQ(file->scene.texts[2].runs[0].text, "tip 0.6 mm");
}

TEST_F(SceneFiles, TextIsReadAsAFileIs) {
  const auto file = loaded(example());
  const auto text = parse_scene(example().dump(), "text", folder_.path().string());
  ASSERT_TRUE(text.ok()) << text.error().message;
  EXPECT_EQ(text->scene.texts.size(), file->scene.texts.size());
  EXPECT_EQ(text->eyes.front().tan_up, file->eyes.front().tan_up);
  const auto refused = parse_scene("{}", "text", "");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("text: format"));
}

TEST_F(SceneFiles, EveryKindIsInTheSchemaAndIsKnown) {
  const json schema = json::parse(content_of(ORTHONAV_SOURCE_DIR "/docs/scene.schema.json"));
  std::set<render::Label> numbers;
  int kinds = 0;
  for (const json& kind : schema["$defs"]["hologram"]["oneOf"]) {
    const std::string type = kind["properties"]["type"]["const"];
    EXPECT_NE(hologram_number(type), 0u) << type;
    numbers.insert(hologram_number(type));
    ++kinds;
  }
  EXPECT_EQ(kinds, 12);
  for (const render::Label n : {1U, 2U, 3U, 4U, 5U, 7U, 8U, 10U, 11U, 12U}) {
    EXPECT_TRUE(numbers.contains(n)) << n;
  }
}

TEST_F(SceneFiles, SayWhatWhereAndTheLimit) {
  EXPECT_THAT(said_about(R"({"type": "arrow"})"),
              HasSubstr("scene.json: holograms[3].type is \"arrow\", must be one of path"));
  EXPECT_THAT(
      said_about(R"({"type": "line", "points_mm": [[0,0,0],[1,0,0]], "width_mm": -1})"),
      HasSubstr("holograms[3].width_mm is -1.000000, must lie in [0.010000, 100.000000] mm"));
  EXPECT_THAT(said_about(R"({"type": "path", "samples_mm": [[0,0],[1,0,0]]})"),
              HasSubstr("holograms[3].samples_mm point 1 must be 3 finite numbers"));
  EXPECT_THAT(said_about(R"({"type": "vertebra", "mesh": "absent.stl"})"), HasSubstr("absent.stl"));
  EXPECT_THAT(said_about(R"({"type": "check_point", "position_mm": [0, 1e9, 0]})"),
              HasSubstr("position_mm holds 1e+09, must lie within 10000 mm of the origin"));
  EXPECT_THAT(said_about(R"({"type": "twin", "site_mm": [0,0,0], "beside": [0,0,0], "of": []})"),
              HasSubstr("beside has no direction"));
  EXPECT_EQ(said_about(R"({"type": "check_point", "position_mm": [0, 1, 0]})"), "nothing");
}

TEST_F(SceneFiles, RefuseNumbersThatNothingCanHave) {
  EXPECT_THAT(said_about(R"({"type": "line", "points_mm": [[0,0,0],[2e4,0,0]], "width_mm": 1})"),
              HasSubstr("points_mm holds 20000, must lie within 10000 mm of the origin"));
  const std::string angle =
      R"({"type": "triangle", "entry_mm": [0,0,0], "tool_mm": [0,9,0], "plan_mm": [1,9,0], )";
  for (const char* bad : {R"("angle_deg": -1})", R"("angle_deg": 181})", R"("angle_degree": 3})"}) {
    EXPECT_THAT(said_about((angle + bad).c_str()), HasSubstr("holograms[3].angle_deg")) << bad;
  }
  EXPECT_EQ(said_about((angle + R"("angle_deg": 180})").c_str()), "nothing");
  EXPECT_THAT(
      said_about(R"({"type": "check_point", "position_mm": [0,0,0], "distance_mm": 1e300})"),
      HasSubstr("distance_mm"));
  EXPECT_THAT(said_about(R"({"type": "rod", "heads_mm": [[0,0,0]], "diameter_mm": -5})"),
              HasSubstr("diameter_mm is -5"));
  EXPECT_THAT(said_about(R"({"type": "cross", "site_mm": [0,0,0], "outward": [0,1,0],
                             "eye_mm": [0,400,0], "tip_offset_mm": [1,0,0],
                             "top_offset_mm": [1,0,0], "depth_mm": 1e9, "to_target_mm": 3})"),
              HasSubstr("depth_mm is 1"));
  json scene = example();
  scene["view"]["width_px"] = 640.5;
  EXPECT_THAT(loaded(scene).error().message, HasSubstr("view.width_px"));
}

TEST_F(SceneFiles, RefuseABoneThatIsMirroredOrStretched) {
  std::ofstream((folder_.path() / "bone.obj").string())
      << "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const auto placed = [this](const std::string& rows) {
    return said_about(
        (R"({"type": "vertebra", "mesh": "bone.obj", "world_from_vertebra": [)" + rows + "]}")
            .c_str());
  };
  EXPECT_EQ(placed("1,0,0,5, 0,1,0,6, 0,0,1,7, 0,0,0,1"), "nothing");
  EXPECT_THAT(placed("-1,0,0,5, 0,1,0,6, 0,0,1,7, 0,0,0,1"), HasSubstr("mirrors"));
  EXPECT_THAT(placed("2,0,0,5, 0,2,0,6, 0,0,2,7, 0,0,0,1"), HasSubstr("not rigid"));
  EXPECT_THAT(placed("1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1"), HasSubstr("row 0, 0, 0, 1"));
}

TEST_F(SceneFiles, RefuseAViewThatSeesNothing) {
  json scene = example();
  scene["view"]["target_mm"] = scene["view"]["eye_mm"];
  EXPECT_THAT(loaded(scene).error().message, HasSubstr("view.target_mm is where the eye is"));
  scene = example();
  scene["view"]["width_px"] = 0;
  EXPECT_THAT(loaded(scene).error().message, HasSubstr("view.width_px is 0"));
  scene = example();
  scene["version"] = 2;
  EXPECT_THAT(loaded(scene).error().message, HasSubstr("version must be 1"));
}

TEST_F(SceneFiles, ATwinIsTwiceAsLargeUnderItsOwnLabel) {
  json scene = example();
  scene["holograms"] = json::array({{{"type", "twin"},
                                     {"site_mm", {0, 0, 0}},
                                     {"beside", {1, 0, 0}},
                                     {"of", json::array({{{"type", "line"},
                                                          {"points_mm", {{0, 0, 0}, {10, 0, 0}}},
                                                          {"width_mm", 1.0}}})}}});
  const auto file = loaded(scene);
  ASSERT_TRUE(file.ok()) << file.error().message;
  ASSERT_EQ(file->scene.lines.size(), 1u);
  EXPECT_EQ(file->scene.lines[0].label, 801u);
  EXPECT_FLOAT_EQ(file->scene.lines[0].points[1].x, 0.170f);
  EXPECT_FLOAT_EQ(file->scene.lines[0].width_m, 0.002f);
}

}  // namespace
}  // namespace orthonav::engine
