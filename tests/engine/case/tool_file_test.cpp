#include "engine/case/tool_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace orthonav::engine::tool_file_test {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string tool(const std::string& fields) {
  return R"({"tools": [{"name": "pointer", "role": "pointer", )" + fields + "}]}";
}
const std::string kMarker = R"("marker": {"family": "tag36h11", "id": 3, "size_mm": 50})";

/// The one line that a tool file is refused with.
std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  const auto tools = load_tools(folder.with("tools.json", text));
  EXPECT_FALSE(tools.ok());
  const std::string message = tools.ok() ? "" : tools.error().message;
  EXPECT_THAT(message, HasSubstr("tools.json: "));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

TEST(ToolFile, ReadsMillimetresIntoMetres) {
  const TemporaryFolder folder;
  const auto tools = load_tools(
      folder.with("tools.json", tool(kMarker + R"(, "tip_mm": [1, -150, 2], "axis": [0, 2, 0])")));
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  ASSERT_EQ(tools->size(), 1u);
  const nav::ToolGeometry& pointer = tools->front();
  EXPECT_EQ(pointer.role, nav::ToolRole::kPointer);
  EXPECT_EQ(pointer.marker.id, 3);
  EXPECT_DOUBLE_EQ(pointer.marker.size_m, 0.050);
  EXPECT_EQ(pointer.tip_in_marker.v, (Vec3{0.001, -0.150, 0.002}));
  EXPECT_EQ(pointer.axis_in_marker.v, (Vec3{0, 1, 0})) << "any length of the axis serves";
}

TEST(ToolFile, WritesWhatItReadsBack) {
  const TemporaryFolder folder;
  const std::vector<nav::ToolGeometry> tools = built_in_tools();
  ASSERT_TRUE(save_tools(folder.file("tools.json"), tools).ok());
  const auto back = load_tools(folder.file("tools.json"));
  ASSERT_TRUE(back.ok()) << back.error().message;
  ASSERT_EQ(back->size(), tools.size());
  for (std::size_t i = 0; i < tools.size(); ++i) {
    EXPECT_EQ((*back)[i].name, tools[i].name);
    EXPECT_EQ((*back)[i].role, tools[i].role);
    EXPECT_EQ((*back)[i].marker.family, tools[i].marker.family);
    EXPECT_EQ((*back)[i].marker.id, tools[i].marker.id);
    EXPECT_DOUBLE_EQ((*back)[i].marker.size_m, tools[i].marker.size_m);
    EXPECT_LT(((*back)[i].tip_in_marker.v - tools[i].tip_in_marker.v).norm(), 1e-12);
  }
}

TEST(ToolFile, HasAPointerAGuideAndAReferenceBuiltIn) {
  const std::vector<nav::ToolGeometry> tools = built_in_tools();
  ASSERT_EQ(tools.size(), 3u);
  EXPECT_EQ(tools[0].role, nav::ToolRole::kPointer);
  EXPECT_EQ(tools[1].role, nav::ToolRole::kGuide);
  EXPECT_EQ(tools[2].role, nav::ToolRole::kReference);
  EXPECT_TRUE(nav::problems_of(tools).empty());
}

TEST(ToolFile, ReadsAToolWithoutATagOnlyWhereThatMayBe) {
  const TemporaryFolder folder;
  const std::string text = tool(R"("tip_mm": [1, -150, 2])");
  const auto tools = load_tools(folder.with("tools.json", text), ToolTags::kOptional);
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  EXPECT_FALSE(tools->front().has_tag());
  EXPECT_EQ(tools->front().tip_in_marker.v, (Vec3{0.001, -0.150, 0.002}));
  EXPECT_THAT(tools_text(*tools), Not(HasSubstr("\"marker\"")));
  EXPECT_THAT(refusal(text), HasSubstr("tools[0].marker is missing"));
  const auto tagged =
      load_tools(folder.with("tagged.json", tool(kMarker + R"(, "tip_mm": [1, -150, 2])")),
                 ToolTags::kOptional);
  ASSERT_TRUE(tagged.ok());
  EXPECT_TRUE(tagged->front().has_tag());
}

TEST(ToolFile, RefusesMissingAndMistypedFieldsByName) {
  const std::string tip = R"(, "tip_mm": [0, -150, 0])";
  EXPECT_THAT(refusal(R"({})"), HasSubstr("tools is missing"));
  EXPECT_THAT(refusal(R"({"tools": []})"), HasSubstr("tools is empty"));
  EXPECT_THAT(refusal(R"({"tools": [5]})"), HasSubstr("tools[0] must be an object"));
  EXPECT_THAT(refusal(tool(kMarker)), HasSubstr("tools[0].tip_mm is missing"));
  EXPECT_THAT(refusal(tool(R"("tip_mm": [0, 0, 0])")), HasSubstr("tools[0].marker is missing"));
  EXPECT_THAT(refusal(tool(R"("marker": {"family": "tag36h11", "id": 3})" + tip)),
              HasSubstr("tools[0].marker.size_mm is missing"));
  EXPECT_THAT(refusal(tool(R"("marker": {"family": "tag36h11", "id": 3.5, "size_mm": 5})" + tip)),
              HasSubstr("tools[0].marker.id must be a whole number"));
  EXPECT_THAT(refusal(tool(kMarker + R"(, "tip_mm": [0, "a", 0])")),
              HasSubstr("tools[0].tip_mm must be a list of 3 finite numbers"));
  EXPECT_THAT(refusal(tool(kMarker + R"(, "tip_mm": [0, 1])")),
              HasSubstr("tools[0].tip_mm holds 2 numbers, must be 3"));
  EXPECT_THAT(refusal(tool(kMarker + tip + R"(, "axis": [0, 0, 0])")),
              HasSubstr("tools[0].axis must not be zero"));
}

TEST(ToolFile, RefusesAnUnknownRole) {
  EXPECT_THAT(refusal(R"({"tools": [{"name": "x", "role": "guide", "level": "L4", )" + kMarker +
                      R"(, "tip_mm": [0, 0, 0]}]})"),
              HasSubstr("is for a reference"));
  EXPECT_THAT(refusal(R"({"tools": [{"name": "x", "role": "hammer", )" + kMarker +
                      R"(, "tip_mm": [0, 0, 0]}]})"),
              HasSubstr("\"hammer\", must be pointer, guide, reference, awl, drill, tap, "
                        "screwdriver or wire"));
}

TEST(ToolFile, KnowsEveryInstrumentByItsRole) {
  for (const char* role :
       {"pointer", "guide", "reference", "awl", "drill", "tap", "screwdriver", "wire"}) {
    const auto tools = parse_tools(R"({"tools": [{"name": "x", "role": ")" + std::string(role) +
                                       R"(", "tip_mm": [0, -100, 0], )" + kMarker + "}]}",
                                   "t");
    ASSERT_TRUE(tools.ok()) << tools.error().message;
    EXPECT_EQ(to_text(tools->front().role), role);
    EXPECT_FALSE(tools->front().stop_m || tools->front().sleeve_length_m);
  }
}

std::string guide_with(const std::string& fields, const std::string& role = "guide") {
  return R"({"tools": [{"name": "g", "role": ")" + role + R"(", "tip_mm": [0, -100, 0], )" +
         kMarker + ", " + fields + "}]}";
}

TEST(ToolFile, ReadsAndWritesSleeveAndStopOfAGuide) {
  const auto tools =
      parse_tools(guide_with(R"("sleeve_length_mm": 90, "stop_mm": 42.5)"), "t").value();
  EXPECT_DOUBLE_EQ(*tools[0].sleeve_length_m, 0.090);
  EXPECT_DOUBLE_EQ(*tools[0].stop_m, 0.0425);
  const auto back = parse_tools(tools_text(tools), "t").value();
  EXPECT_DOUBLE_EQ(*back[0].sleeve_length_m, 0.090);
  EXPECT_DOUBLE_EQ(*back[0].stop_m, 0.0425);
}

TEST(ToolFile, RefusesSleevesAndStopsThatCanNotBe) {
  EXPECT_THAT(refusal(guide_with(R"("stop_mm": -3)")), HasSubstr("stop -3 mm, must be 1-150 mm"));
  EXPECT_THAT(refusal(guide_with(R"("stop_mm": 0.042)")), HasSubstr("stop 0.042 mm"))
      << "metres taken for millimetres";
  EXPECT_THAT(refusal(guide_with(R"("stop_mm": "deep")")), HasSubstr("stop_mm"));
  EXPECT_THAT(refusal(guide_with(R"("stop_mm": 1e999)")), HasSubstr("too large"));
  EXPECT_THAT(refusal(guide_with(R"("sleeve_length_mm": 5)")), HasSubstr("must be 10-300 mm"));
  EXPECT_THAT(refusal(guide_with(R"("stop_mm": 40)", "pointer")), HasSubstr("is for a guide"));
}

TEST(ToolFile, RefusesAnUnknownFamily) {
  EXPECT_THAT(refusal(tool(R"("marker": {"family": "tag99h1", "id": 3, "size_mm": 50},
                              "tip_mm": [0, 0, 0])")),
              HasSubstr("tag99h1"));
}

TEST(ToolFile, RefusesTheSameTagOnTwoTools) {
  const std::string rest = kMarker + R"(, "tip_mm": [0, -100, 0]})";
  EXPECT_THAT(refusal(R"({"tools": [{"name": "a", "role": "pointer", )" + rest +
                      R"(, {"name": "b", "role": "guide", )" + rest + "]}"),
              HasSubstr("3"));
}

const std::string kTip = R"(, "tip_mm": [0, -150, 0])";

/// A pointer with a second tag, turned and to the right, with this pose.
std::string with_second_tag(const std::string& rows, const std::string& fields =
                                                         R"("family": "tag36h11", "id": 4,
                                                            "size_mm": 40)") {
  return tool(kMarker + kTip + R"(, "markers": [{)" + fields + R"(, "pose": )" + rows + "}]");
}
const std::string kRotated = "[[0,0,1,20], [0,1,0,1.5], [-1,0,0,-20], [0,0,0,1]]";

TEST(ToolFile, ReadsAndWritesFurtherTags) {
  const TemporaryFolder folder;
  const auto tools = load_tools(folder.with("tools.json", with_second_tag(kRotated)));
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  ASSERT_EQ(tools->front().more_markers.size(), 1u);
  const nav::AttachedMarker& second = tools->front().more_markers.front();
  EXPECT_EQ(second.definition.id, 4);
  EXPECT_DOUBLE_EQ(second.definition.size_m, 0.040);
  const Point<Marker> right_of_second = second.marker_from_tag * Point<Tag>{{0.01, 0, 0}};
  EXPECT_LT((right_of_second.v - Vec3{0.02, 0.0015, -0.03}).norm(), 1e-12);

  const auto back = parse_tools(tools_text(*tools), "back");
  ASSERT_TRUE(back.ok()) << back.error().message;
  ASSERT_EQ(back->front().more_markers.size(), 1u);
  const nav::AttachedMarker& again = back->front().more_markers.front();
  EXPECT_EQ(again.definition.family, "tag36h11");
  EXPECT_EQ(again.definition.id, 4);
  EXPECT_DOUBLE_EQ(again.definition.size_m, 0.040);
  EXPECT_EQ(again.marker_from_tag.rotation(), second.marker_from_tag.rotation());
  EXPECT_LT((again.marker_from_tag.translation() - second.marker_from_tag.translation()).norm(),
            1e-15);
}

TEST(ToolFile, RefusesFurtherTagsThatAreNoRigidPart) {
  EXPECT_THAT(refusal(with_second_tag("[[1,0,0,0], [0,1.01,0,0], [0,0,1,0], [0,0,0,1]]")),
              HasSubstr("tools[0].markers[0].pose transform is not rigid"));
  EXPECT_THAT(refusal(with_second_tag("[[1,0,0,0], [0,1,0,0], [0,0,-1,0], [0,0,0,1]]")),
              HasSubstr("tools[0].markers[0].pose transform mirrors"));
  EXPECT_THAT(refusal(with_second_tag("[[1,0,0,0], [0,1,0,0], [0,0,1,0], [0,0,9,1]]")),
              HasSubstr("must end with the row 0 0 0 1"));
  EXPECT_THAT(refusal(with_second_tag("[[1,0,0,0], [0,1,0,0], [0,0,1,0]]")),
              HasSubstr("holds 12 numbers, must be 16"));
  EXPECT_THAT(refusal(with_second_tag("5")), HasSubstr("markers[0].pose must be a list"));
  EXPECT_THAT(refusal(with_second_tag("[[1,0,0,2000], [0,1,0,0], [0,0,1,0], [0,0,0,1]]")),
              HasSubstr("lies 2000 mm from its marker"));
}

TEST(ToolFile, RefusesFurtherTagsThatAreIncompleteOrTwice) {
  EXPECT_THAT(refusal(with_second_tag(kRotated, R"("family": "tag36h11", "id": 4)")),
              HasSubstr("tools[0].markers[0].size_mm is missing"));
  EXPECT_THAT(refusal(with_second_tag(kRotated, R"("id": 4, "size_mm": 40)")),
              HasSubstr("tools[0].markers[0].family is missing"));
  EXPECT_THAT(refusal(with_second_tag(kRotated, R"("family": "tag36h11", "id": 3, "size_mm": 4)")),
              AllOf(HasSubstr("id 3 is already on tool 'pointer'"), HasSubstr("4 mm")));
  EXPECT_THAT(refusal(tool(kMarker + kTip + R"(, "markers": {})")),
              HasSubstr("tools[0].markers must be a list"));
  EXPECT_THAT(refusal(tool(kMarker + kTip + R"(, "markers": [7])")),
              HasSubstr("tools[0].markers[0] must be an object"));
}

TEST(ToolFile, ChangesOneToolAndNothingElse) {
  const TemporaryFolder folder;
  const std::string path = folder.with("tools.json", R"({"note": "theatre 2", "tools": [
    {"name": "a", "role": "pointer", "serial": 17, "axis": [0, 0, 1],
     "marker": {"family": "tag36h11", "id": 3, "size_mm": 50, "print": "A4"}, "tip_mm": [0, -1, 0]},
    {"name": "b", "role": "guide",
     "marker": {"family": "tag36h11", "id": 5, "size_mm": 50}, "tip_mm": [0, -2, 0]}]})");
  const nav::AttachedMarker more{{"tag36h11", 9, 0.03}, {Mat3::identity(), {0.05, 0, 0}}};
  const auto changed =
      changed_tools(path, "a", {.tip_in_marker = {{{0.001, -0.1, 0}}}, .more_markers = {{more}}});
  ASSERT_TRUE(changed.ok()) << changed.error().message;
  EXPECT_THAT(*changed, AllOf(HasSubstr("\"theatre 2\""), HasSubstr("\"serial\": 17"),
                              HasSubstr("\"print\": \"A4\"")));
  const auto tools = parse_tools(*changed, "changed");
  ASSERT_TRUE(tools.ok()) << tools.error().message;
  ASSERT_EQ(tools->size(), 2u);
  EXPECT_LT((tools->at(0).tip_in_marker.v - Vec3{0.001, -0.1, 0}).norm(), 1e-15);
  EXPECT_EQ(tools->at(0).axis_in_marker.v, (Vec3{0, 0, 1}));
  ASSERT_EQ(tools->at(0).more_markers.size(), 1u);
  EXPECT_EQ(tools->at(0).more_markers[0].definition.id, 9);
  EXPECT_EQ(tools->at(1).tip_in_marker.v, (Vec3{0, -0.002, 0}));
  EXPECT_TRUE(load_tools(path)->at(0).more_markers.empty()) << "the file itself is not";
}

TEST(ToolFile, RefusesAChangeThatMakesABadFile) {
  const TemporaryFolder folder;
  const std::string path = folder.with("tools.json", tool(kMarker + kTip));
  EXPECT_THAT(changed_tools(path, "hook", {}).error().message,
              HasSubstr("no tool is named 'hook' (there are: pointer)"));
  EXPECT_THAT(changed_tools(path, "pointer", {.tip_in_marker = {{{0, -1.5, 0}}}}).error().message,
              HasSubstr("as changed: tool 'pointer': tip 1500 mm"));
  const nav::AttachedMarker same{{"tag36h11", 3, 0.03}, {}};
  EXPECT_FALSE(changed_tools(path, "pointer", {.more_markers = {{same}}}).ok());
  EXPECT_TRUE(changed_tools(path, "pointer", {}).ok());
}

TEST(ToolFile, RefusesWhatIsNotJsonOrNotThere) {
  EXPECT_THAT(refusal("{\"tools\": [1, 2"), HasSubstr("is not JSON"));
  EXPECT_THAT(refusal(""), HasSubstr("is not JSON"));
  EXPECT_THAT(refusal("[]"), HasSubstr("must hold a JSON object"));
  EXPECT_THAT(refusal(tool(R"("marker": {"family": "tag36h11", "id": 3, "size_mm": 1e999})")),
              HasSubstr("too large"));
  EXPECT_THAT(load_tools("/nowhere/tools.json").error().message, HasSubstr("cannot be opened"));
  EXPECT_THAT(load_tools("/tmp").error().message, HasSubstr("is a folder"));
}

}  // namespace
}  // namespace orthonav::engine::tool_file_test
