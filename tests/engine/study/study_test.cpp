#include "engine/study/study.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"

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
  for (std::size_t i = 0; i < texts.size(); ++i) {
    names.push_back("part" + std::to_string(i + 1));
  }
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
  EXPECT_THAT(merged({"{", one}).error().message, HasSubstr("part1: is not a study"));
  EXPECT_THAT(merged({"[]"}).error().message, HasSubstr("is not a study"));
  EXPECT_THAT(merged({study_of("paper", {json{{"case", "a"}}})}).error().message,
              HasSubstr("a run lacks"));
}

TEST(Study, KeepsWhatFailedThroughAMerge) {
  json part = json::parse(study_of("paper", {run_of("a", 1, 3.0)}));
  part["failed"] = {{{"case", "a"}, {"seed", 2}, {"why", "no room"}}};
  const auto all = merged({part.dump(), study_of("paper", {run_of("b", 1, 3.0)})});
  ASSERT_TRUE(all.ok()) << all.error().message;
  EXPECT_EQ(json::parse(*all)["failed"], part["failed"]);
  EXPECT_EQ(json::parse(*all)["operations"], 2);
}

TEST(Study, RefusesRunsWhoseFieldsAreOfAnotherType) {
  json run = run_of("a", 1, 3.0);
  run["completed"] = "yes";
  EXPECT_EQ(merged({study_of("paper", {run})}).error().message,
            "part1: completed of a run is \"yes\", must be true or false");
  run = run_of("a", 1, 3.0);
  run["levels"] = {1};
  EXPECT_THAT(merged({study_of("paper", {run})}).error().message, HasSubstr("part1: a level"));
}

TEST(Study, IsAnErrorWhereNoRunCouldBeMade) {
  StudyOptions options;
  options.runs = 2;
  options.operation.levels = {"T1"};
  const Case spine = phantom({"L5"});
  const auto study = run_study({&spine, 1}, options);
  ASSERT_FALSE(study.ok());
  EXPECT_THAT(study.error().message, HasSubstr("case 'phantom', seed 1: "));
}

TEST(Study, KeepsTheRunsThatCouldBeMadeBesideOneThatCouldNot) {
  StudyOptions options;
  options.runs = 1;
  options.operation.levels = {"L5"};
  options.operation.tools = built_in_tools();
  options.operation.loop.draw_every = 0;
  options.operation.loop.max_frames = 2;
  const std::vector<Case> cases = {phantom({"L4"}), phantom({"L5"})};
  const auto study = run_study(cases, options);
  ASSERT_TRUE(study.ok()) << study.error().message;
  ASSERT_TRUE(study->failure.has_value());
  EXPECT_THAT(study->failure->message, HasSubstr("no level 'L5'"));
  const json text = json::parse(study->text);
  EXPECT_EQ(text["operations"], 1);
  EXPECT_EQ(text["failed"].size(), 1u);
  EXPECT_EQ(text["runs"][0]["why_not"], "ended at setup of L5");
  EXPECT_EQ(text["table"][4]["count"], 0) << "a level never registered has no points";
}

TEST(Study, KeepsWhatWasMadeWhenItIsStoppedAndSaysThatItIsIncomplete) {
  StudyOptions options;
  options.runs = 3;
  options.operation.levels = {"L5"};
  options.operation.tools = built_in_tools();
  options.operation.loop.draw_every = 0;
  options.operation.loop.max_frames = 2;
  const Case spine = phantom({"L5"});
  std::function<void()> stop;
  bool told_of_the_end = false;
  const auto study = run_study(
      {&spine, 1}, options,
      [&stop](int /*done*/, int /*all*/) {
        // From another thread, as a signal does; this one holds what the study guards.
        std::thread(stop).detach();
      },
      [&](std::function<void()> asked) {
        told_of_the_end = !asked;
        stop = std::move(asked);
      });
  ASSERT_TRUE(study.ok()) << study.error().message;
  EXPECT_TRUE(told_of_the_end);
  EXPECT_EQ(study->planned, 3);
  const json text = json::parse(study->text);
  EXPECT_EQ(text["operations"], study->made);
  EXPECT_EQ(text.value("incomplete", false), study->made < 3);
}

TEST(Study, AMergeWithAnIncompleteShardIsIncomplete) {
  json part = json::parse(study_of("paper", {run_of("a", 1, 2.0)}));
  part["incomplete"] = true;
  part["planned"] = 5;
  const json all = json::parse(*merged({part.dump(), study_of("paper", {run_of("b", 1, 3.0)})}));
  EXPECT_EQ(all["incomplete"], true);
  EXPECT_EQ(all["planned"], 6);
  EXPECT_FALSE(
      json::parse(*merged({study_of("paper", {run_of("b", 1, 3.0)})})).contains("planned"));
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
