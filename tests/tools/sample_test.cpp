#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/command_line.h"

namespace orthonav::test::sample_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// What the scan, the case and the other recording are good for: tests/first_screw.
TEST(SampleCommand, WritesToolsPointsACaseAndRecordings) {
  const ScratchFolder folder;
  const std::string sample = folder.file("sample");
  const Called called = orthonav({"sample", sample});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(folder.names(), ElementsAre("sample"));
  const Called found = orthonav({"register", "--case", sample + "/case", "--level", "L4",
                                 "--points", sample + "/points.csv", "--json", "-"});
  EXPECT_EQ(found.code, 0) << found.err;
  const auto pose = nlohmann::json::parse(found.out)["model_to_points"];
  // Where the sample's tracker has the vertebra.
  EXPECT_NEAR(pose[0][3].get<double>(), 200.0, 0.5);
  EXPECT_NEAR(pose[1][3].get<double>(), 900.0, 0.5);
  EXPECT_NEAR(pose[2][3].get<double>(), -400.0, 0.5);
  const Called tracked = orthonav({"track", sample + "/pivoting", "--tools", sample + "/tools.json",
                                   "--csv", folder.file("poses.csv")});
  EXPECT_EQ(tracked.code, 0) << tracked.err;
  const std::string poses = content_of(folder.file("poses.csv"));
  EXPECT_GT(std::count(poses.begin(), poses.end(), '\n'), 70);
  // No second sample over it.
  const Called again = orthonav({"sample", sample});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("already exists and is not an empty folder"));
}

TEST(SampleCommand, RefusesAPlaceThatIsTakenAndLeavesNothing) {
  const ScratchFolder folder;
  const std::string file = folder.with("file", "mine");
  for (const std::string& place : {file, file + "/below", folder.file("")}) {
    const Called called = orthonav({"sample", place});
    EXPECT_EQ(called.code, 2) << place;
    EXPECT_THAT(called.out, IsEmpty());
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
  }
  EXPECT_EQ(content_of(file), "mine");
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

}  // namespace
}  // namespace orthonav::test::sample_test
