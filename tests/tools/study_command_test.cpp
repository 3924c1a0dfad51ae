#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/tools/command_line.h"

namespace orthonav::test::study_command_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// A study of one method over operations with these angles, seeds from 1.
std::string study_text(const std::string& method, const std::vector<double>& angles_deg) {
  json runs = json::array();
  for (const double angle_deg : angles_deg) {
    const json screw = {{"side", "left"}, {"angle_error_deg", angle_deg}};
    runs.push_back({{"case", "phantom"},
                    {"seed", runs.size() + 1},
                    {"completed", true},
                    {"levels", {{{"label", "L5"}, {"screws", json::array({screw})}}}}});
  }
  return json{{"method", method}, {"runs", runs}}.dump();
}

TEST(StudyCompare, PrintsATableAndWritesJsonAndPage) {
  const ScratchFolder folder;
  const std::string best = folder.with("best.json", study_text("best", {1.0, 2.0, 3.0}));
  const std::string paper = folder.with("paper.json", study_text("paper", {2.0, 4.0, 6.0}));
  const Called called = orthonav({"study", "compare", best, paper, "--json", folder.file("o.json"),
                                  "--report", folder.file("page.html")});
  ASSERT_EQ(called.code, 0) << called.err;
  EXPECT_THAT(called.out, StartsWith("3 operations in both studies"));
  EXPECT_THAT(called.out, HasSubstr("| Trajectory error, ° | 2.00 | 4.00 | -2.00 | "));
  const json figures = json::parse(content_of(folder.file("o.json")));
  EXPECT_EQ(figures["first"], "best");
  EXPECT_EQ(figures["quantities"][0]["difference"], -2.0);
  EXPECT_THAT(content_of(folder.file("page.html")), HasSubstr("best less paper"));
  const Called alone = orthonav({"study", "compare", best, paper, "--json"});
  EXPECT_EQ(json::parse(alone.out), figures) << "standard output holds the JSON and nothing else";
}

TEST(StudyCompare, RefusesInOneLine) {
  const ScratchFolder folder;
  const std::string one = folder.with("one.json", study_text("best", {1.0}));
  const std::string none = folder.with("none.json", study_text("paper", {}));
  const auto refusal = [&](const std::vector<std::string>& files) {
    std::vector<std::string> words = {"study", "compare"};
    words.insert(words.end(), files.begin(), files.end());
    const Called called = orthonav(words);
    EXPECT_EQ(called.code, 2);
    EXPECT_THAT(called.out, IsEmpty());
    EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
    return called.err;
  };
  EXPECT_THAT(refusal({one, none}), HasSubstr("none.json: no operation in common"));
  EXPECT_THAT(refusal({one}), HasSubstr("B is required"));
  EXPECT_THAT(refusal({one, folder.file("absent")}), HasSubstr("absent: cannot be opened"));
  EXPECT_THAT(refusal({one, folder.with("x.db", "no study")}), HasSubstr("x.db: is not a study"));
}

// A page tells of each operation how to make it again.
TEST(StudyPage, HasTheCommandThatMakesAnOperationAgain) {
  const ScratchFolder folder;
  const std::string page = folder.file("page.html");
  const Called study = orthonav({"study", "--measurement", "model", "--method", "paper", "--levels",
                                 "L5", "--runs", "1", "--report", page});
  ASSERT_EQ(study.code, 0) << study.err;
  EXPECT_THAT(content_of(page),
              HasSubstr("<span>orthonav study</span> <span>--method paper</span> "
                        "<span>--measurement model</span> <span>--levels L5</span> "
                        "<span>--runs 1</span> <span>--seed 1  # the same bones and hands on "
                        "pixels: orthonav preview</span> <span>--replay 1</span> "
                        "<span>--method paper</span> <span>--levels L5</span>"));
}

}  // namespace
}  // namespace orthonav::test::study_command_test
