#include "engine/case/reference_levels.h"

#include <gmock/gmock.h>

#include "engine/case/tool_file.h"

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;

nav::ToolGeometry reference_on(const std::string& level) {
  nav::ToolGeometry tool = tool_named(built_in_tools(), "reference").value();
  tool.level = level;
  return tool;
}

/// Of L1 to L5, 40 mm apart, one is operated.
Operation lumbar(const std::string& operated) {
  Operation operation;
  operation.case_name = "spine";
  operation.levels.push_back({operated, nullptr, {}, {}});
  double height_m = 0.0;
  for (const char* label : {"L5", "L4", "L3", "L2", "L1"}) {
    operation.spine.push_back({label, height_m});
    height_m += 0.040;
  }
  return operation;
}

TEST(References, ReachTwoVertebraeFar) {
  EXPECT_TRUE(check_references(lumbar("L4"), {reference_on("L4")}).ok());
  EXPECT_TRUE(check_references(lumbar("L3"), {reference_on("L5")}).ok());
  const Status far = check_references(lumbar("L2"), {reference_on("L5")});
  ASSERT_FALSE(far.ok());
  EXPECT_EQ(far.error().message,
            "level 'L2': the nearest reference, 'reference' on L5, is 3 vertebrae away, limit 2");
}

TEST(References, TheNearestOfSeveralCounts) {
  nav::ToolGeometry second = reference_on("L1");
  second.name = "second";
  EXPECT_TRUE(check_references(lumbar("L2"), {reference_on("L5"), second}).ok());
}

TEST(References, LevelsThatACaseLeavesOutAreCountedByHeight) {
  Operation operation = lumbar("L1");
  operation.spine = {{"L5", 0.0}, {"L1", 0.15}};
  EXPECT_THAT(check_references(operation, {reference_on("L5")}).error().message,
              HasSubstr("is 4 vertebrae away"));
}

TEST(References, OneThatSaysNoLevelLimitsNothing) {
  EXPECT_TRUE(check_references(lumbar("L1"), {reference_on("")}).ok());
  EXPECT_TRUE(check_references(lumbar("L1"), {}).ok());
}

TEST(References, OneOnNoLevelOfTheCaseIsRefused) {
  EXPECT_THAT(check_references(lumbar("L1"), {reference_on("T4")}).error().message,
              HasSubstr("clamped to 'T4', which is not a level of case"));
}

}  // namespace
}  // namespace orthonav::engine
