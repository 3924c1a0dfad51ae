#include "study/study.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "study/study_reading.h"
#include "study/study_text.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

Json run_of(const std::string& name, std::uint64_t seed, double angle_deg) {
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

/// The study of the method of the paper, planned so large, in which these runs were made.
Json study_of(const std::vector<Json>& runs, int planned) {
  auto store =
      StudyStore::open("", Json{{"method", "paper"}, {"runs", planned}, {"cases", {"one"}}}.dump());
  EXPECT_TRUE(store.ok());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_TRUE(
        store->add({static_cast<int>(i), runs[i]["case"], runs[i]["seed"], runs[i].dump(), ""})
            .ok());
  }
  return Json::parse(*study_text(*store));
}

TEST(Study, HasTheTableOverItsRuns) {
  const Json study = study_of({run_of("a", 1, 3.0), run_of("a", 2, 2.0), run_of("b", 1, 4.0)}, 3);
  EXPECT_EQ(study["operations"], 3);
  EXPECT_EQ(study["completed"], 3);
  EXPECT_FALSE(study.contains("planned"));
  ASSERT_EQ(study["table"].size(), 5u);
  const Json& angle = study["table"][0];
  EXPECT_EQ(angle["name"], "Trajectory error");
  EXPECT_EQ(angle["count"], 3);
  EXPECT_DOUBLE_EQ(angle["mean"], 3.0);
  EXPECT_DOUBLE_EQ(angle["sd"], 1.0);
  EXPECT_DOUBLE_EQ(angle["min"], 2.0);
  EXPECT_DOUBLE_EQ(angle["max"], 4.0);
  EXPECT_EQ(study["table"][1]["count"], 0) << "no entry error was measured";
}

TEST(Study, ThatLacksRunsIsIncomplete) {
  const Json study = study_of({run_of("a", 1, 3.0)}, 5);
  EXPECT_EQ(study["incomplete"], true);
  EXPECT_EQ(study["planned"], 5);
}

std::string refusal_of(const Json& study) {
  const auto parsed = parse_study(study.dump(), "part1");
  return parsed ? "" : parsed.error().message;
}

TEST(Study, RefusesRunsWhoseFieldsAreOfAnotherType) {
  EXPECT_THAT(refusal_of(Json::array()), HasSubstr("part1: is not a study"));
  EXPECT_THAT(refusal_of({{"method", "paper"}, {"runs", {{{"case", "a"}}}}}),
              HasSubstr("a run lacks"));
  Json run = run_of("a", 1, 3.0);
  EXPECT_EQ(refusal_of({{"method", "paper"}, {"runs", {run}}}), "");
  run["completed"] = "yes";
  EXPECT_EQ(refusal_of({{"method", "paper"}, {"runs", {run}}}),
            "part1: completed of a run is \"yes\", must be true or false");
  run = run_of("a", 1, 3.0);
  run["levels"] = {1};
  EXPECT_THAT(refusal_of({{"method", "paper"}, {"runs", {run}}}), HasSubstr("part1: a level"));
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
  const Json text = Json::parse(study->text);
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
  const Json text = Json::parse(study->text);
  EXPECT_EQ(text["operations"], study->made);
  EXPECT_EQ(text.value("incomplete", false), study->made < 3);
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
