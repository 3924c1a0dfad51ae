#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "engine/case/plan_file.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

std::string file_of(const std::string& markup) {
  return R"({"@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/)"
         R"(Markups/Resources/Schema/markups-schema-v1.0.3.json#", "markups": [)" +
         markup + "]}";
}

std::string point(const std::string& label, double x_mm, double y_mm) {
  return R"({"label": ")" + label + R"(", "position": [)" + std::to_string(x_mm) + ", " +
         std::to_string(y_mm) + R"(, 0], "positionStatus": "defined"})";
}

std::string markup(const std::string& type, const std::string& name, const std::string& points,
                   const std::string& axes = "LPS") {
  return R"({"type": ")" + type + R"(", "name": ")" + name + R"(", "coordinateSystem": ")" + axes +
         R"(", "coordinateUnits": "mm", "controlPoints": [)" + points + "]}";
}

std::string line(const std::string& name, double x_mm, const std::string& axes = "LPS") {
  return markup("Line", name, point("", x_mm, 30) + "," + point("", 0.5 * x_mm, -10), axes);
}

std::string refusal(const std::vector<std::string>& paths) {
  const auto plan = load_plan(paths);
  EXPECT_FALSE(plan.ok());
  return plan.ok() ? "" : plan.error().message;
}

TEST(PlanOfFiles, HoldsTheScrewsOfAll) {
  const TemporaryFolder folder;
  const std::vector<std::string> paths = {
      folder.with("left.mrk.json", file_of(line("L4 left diameter=6.5", 18))),
      folder.with("right.mrk.json", file_of(line("right", -18)))};
  const auto plan = load_plan(paths);
  ASSERT_TRUE(test::is_ok(plan));
  EXPECT_EQ(plan->level, "L4");
  ASSERT_EQ(plan->screws.size(), 2u);
  EXPECT_EQ(plan->screws[0].side, nav::Side::kLeft);
  EXPECT_NEAR(plan->screws[0].radius_m, 0.00325, 1e-9);
  EXPECT_EQ(plan->screws[1].side, nav::Side::kRight);
  EXPECT_THAT(plan->screws[1].where, HasSubstr("right.mrk.json: line \"right\""));
}

TEST(PlanOfFiles, IsOfOneLevelAndOneFrame) {
  const TemporaryFolder folder;
  const std::string left = folder.with("left.mrk.json", file_of(line("L4 left", 18)));
  const std::string level = folder.with("level.mrk.json", file_of(line("L5 right", -18)));
  const std::string frame = folder.with("frame.mrk.json", file_of(line("right", -18, "RAS")));
  EXPECT_THAT(refusal({left, level}), HasSubstr("level.mrk.json: plans L5, must be L4 as in "));
  EXPECT_THAT(refusal({left, frame}),
              HasSubstr("frame.mrk.json: must have the frame and the unit of "));
  EXPECT_THAT(refusal({left, folder.file("none.mrk.json")}), HasSubstr("none.mrk.json"));
}

TEST(PlanOfFiles, ReadsAListOfPointsInPairs) {
  const TemporaryFolder folder;
  const std::string points = point("left entry", 18, 30) + "," + point("left target", 9, -10) +
                             "," + point("right entry", -18, 30) + "," +
                             point("right target", -9, -10);
  const auto plan =
      load_plan(folder.with("L4.mrk.json", file_of(markup("Fiducial", "L4", points))));
  ASSERT_TRUE(test::is_ok(plan));
  EXPECT_EQ(plan->level, "L4");
  ASSERT_EQ(plan->screws.size(), 2u);
  EXPECT_EQ(plan->screws[0].side, nav::Side::kLeft);
  EXPECT_NEAR(plan->screws[0].entry.v.x, 0.018, 1e-9);
  EXPECT_EQ(plan->screws[1].side, nav::Side::kRight);
  EXPECT_NEAR(plan->screws[1].target.v.x, -0.009, 1e-9);
}

TEST(PlanOfFiles, RefusesAPointWithoutAPartner) {
  const TemporaryFolder folder;
  const std::string points = point("", 18, 30) + "," + point("", 9, -10) + "," + point("", -18, 30);
  EXPECT_THAT(refusal({folder.with("L4.mrk.json", file_of(markup("Fiducial", "L4", points)))}),
              HasSubstr("L4.mrk.json: points 3 and 4 of \"L4\": the second one is missing"));
}

}  // namespace
}  // namespace orthonav::engine
