#include "engine/study.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace orthonav::engine {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json run_of(const std::string& name, std::uint64_t seed, double angle_deg) {
  return {{"method", "paper"},
          {"seed", seed},
          {"case", name},
          {"completed", true},
          {"levels",
           {{{"label", "L4"},
             {"accepted", true},
             {"rmse_mm", 1.5},
             {"points", 1000},
             {"digitization_s", 120.0},
             {"screws", {{{"side", "left"}, {"angle_error_deg", angle_deg}}}}}}}};
}

std::string study_of(const std::string& method, const std::vector<json>& runs) {
  return json{{"method", method}, {"runs", runs}}.dump();
}

Result<std::string> merged(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < texts.size(); ++i) names.push_back("part" + std::to_string(i + 1));
  return merge_studies(texts, names);
}

TEST(Study, MergesShardsInTheOrderOfCaseAndSeed) {
  const auto all = merged({study_of("paper", {run_of("b", 1, 4.0), run_of("a", 2, 2.0)}),
                           study_of("paper", {run_of("a", 1, 3.0)})});
  ASSERT_TRUE(all.ok()) << all.error().message;
  const json study = json::parse(*all);
  EXPECT_EQ(study["operations"], 3);
  EXPECT_EQ(study["completed"], 3);
  ASSERT_EQ(study["runs"].size(), 3u);
  EXPECT_EQ(study["runs"][0]["case"], "a");
  EXPECT_EQ(study["runs"][0]["seed"], 1);
  EXPECT_EQ(study["runs"][2]["case"], "b");
  ASSERT_EQ(study["table"].size(), 5u);
  const json& angle = study["table"][0];
  EXPECT_EQ(angle["name"], "Trajectory error");
  EXPECT_EQ(angle["count"], 3);
  EXPECT_DOUBLE_EQ(angle["mean"], 3.0);
  EXPECT_DOUBLE_EQ(angle["sd"], 1.0);
  EXPECT_DOUBLE_EQ(angle["min"], 2.0);
  EXPECT_DOUBLE_EQ(angle["max"], 4.0);
  EXPECT_EQ(study["table"][1]["count"], 0) << "no entry error was measured";
}

TEST(Study, TheOrderOfTheShardsDoesNotMatter) {
  const std::string one = study_of("paper", {run_of("a", 1, 3.0)});
  const std::string two = study_of("paper", {run_of("a", 2, 2.0)});
  EXPECT_EQ(*merged({one, two}), *merged({two, one}));
}

TEST(Study, RefusesWhatDoesNotBelongTogether) {
  const std::string one = study_of("paper", {run_of("a", 1, 3.0)});
  EXPECT_THAT(merged({one, one}).error().message, HasSubstr("part2: case 'a' with seed 1"));
  EXPECT_THAT(merged({one, study_of("best", {})}).error().message, HasSubstr("method 'best'"));
  EXPECT_THAT(merged({"{", one}).error().message, HasSubstr("part1: is no study"));
  EXPECT_THAT(merged({"[]"}).error().message, HasSubstr("is no study"));
  EXPECT_THAT(merged({study_of("paper", {json{{"case", "a"}}})}).error().message,
              HasSubstr("a run lacks"));
}

TEST(Study, RefusesOptionsWithAReason) {
  StudyOptions options;
  EXPECT_TRUE(options.check().empty());
  options.runs = 0;
  options.shard = 3;
  options.shards = 2;
  options.jobs = 0;
  EXPECT_EQ(options.check().size(), 3u);
}

}  // namespace
}  // namespace orthonav::engine
