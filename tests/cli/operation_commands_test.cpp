#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/command_line.h"

namespace orthonav::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Exit code 2, nothing on standard output, one line that says why.
void expect_refusal(const Called& called, const std::string& reason) {
  EXPECT_EQ(called.code, 2) << called.err;
  EXPECT_THAT(called.out, IsEmpty());
  EXPECT_THAT(called.err, HasSubstr(reason));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
}

TEST(DemoCommand, RefusesWhatItCannotDoAndLeavesNothing) {
  const ScratchFolder folder;
  const std::string out = folder.file("out");
  expect_refusal(orthonav({"demo", "--out", out, "--method", "best"}),
                 "best: not available in this version (available: paper)");
  expect_refusal(orthonav({"demo", "--out", out, "--case", folder.file("none")}), "none");
  expect_refusal(orthonav({"demo", "--out", out, "--levels", "L5,T1"}),
                 "no level 'T1' (it has: L1, L2, L3, L4, L5)");
  expect_refusal(orthonav({"demo", "--out", out, "--levels", "L5,L5"}), "named twice");
  expect_refusal(orthonav({"demo", "--out", out, "--device", "no such device"}), "no such device");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(DemoCommand, RefusesAFileInThePlaceOfItsFolder) {
  const ScratchFolder folder;
  const std::string file = folder.with("out", "mine");
  EXPECT_EQ(orthonav({"demo", "--out", file}).code, 2);
  EXPECT_EQ(content_of(file), "mine");
}

TEST(RunCommand, EndsAfterTheFramesAskedForAndRecordsThem) {
  const ScratchFolder folder;
  const std::string recording = folder.file("recording");
  const Called live = orthonav({"run", "--headset", "sim:?seed=3", "--levels", "L5", "--frames",
                                "6", "--json", "--record", recording});
  ASSERT_EQ(live.code, 0) << live.err;
  const json report = json::parse(live.out);
  EXPECT_EQ(report["method"], "paper");
  EXPECT_EQ(report["frames"]["displayed"], 6);
  EXPECT_EQ(report["levels"][0]["label"], "L5");
  EXPECT_EQ(report["levels"][0]["accepted"], false);
  EXPECT_FALSE(report["levels"][0].contains("points")) << "none were registered: no 0 for a mean";
  EXPECT_EQ(report["seed"], 3) << "of the headset that was opened";
  EXPECT_EQ(report["why_not"], "ended at setup of L5");

  // Without a limit the answer is no: the recording ends before the operation does.
  const Called again =
      orthonav({"run", "--headset", "replay:" + recording, "--levels", "L5", "--json"});
  EXPECT_EQ(again.code, 1) << again.err;
  EXPECT_EQ(json::parse(again.out)["frames"]["displayed"], 6);
  EXPECT_FALSE(json::parse(again.out).contains("seed")) << "a recording has none";
}

TEST(RunCommand, RefusesBadInput) {
  const ScratchFolder folder;
  expect_refusal(orthonav({"run", "--headset", "holo:"}), "unknown scheme");
  expect_refusal(orthonav({"run", "--headset", "replay:" + folder.file("none")}), "none");
  expect_refusal(orthonav({"run", "--method", "best"}), "best: not available");
  expect_refusal(orthonav({"run", "--tools", folder.with("t.json", "{}")}), "t.json");
}

TEST(StudyCommand, RefusesBadInput) {
  const ScratchFolder folder;
  expect_refusal(orthonav({"study", "--shard", "3/2"}), "--shard 3/2");
  expect_refusal(orthonav({"study", "--shard", "1/2x"}), "--shard 1/2x");
  expect_refusal(orthonav({"study", "--runs", "0"}), "--runs: \"0\"");
  expect_refusal(orthonav({"study", "--cases", folder.file("none")}), "no case.json");
  expect_refusal(orthonav({"study", "merge", folder.with("a.json", "[]")}), "is no study");
  const std::string words = folder.with("words.json", R"({"method": "paper", "runs": [
      {"case": "a", "seed": 1, "completed": "yes", "levels": []}]})");
  expect_refusal(orthonav({"study", "merge", words}),
                 "words.json: completed of a run is \"yes\", must be true or false");
}

TEST(StudyCommand, MergesShards) {
  const ScratchFolder folder;
  const auto shard = [&](const std::string& name, int seed) {
    const json run{{"case", "phantom"},
                   {"seed", seed},
                   {"completed", true},
                   {"levels", json::array({{{"label", "L5"}, {"rmse_mm", 1.0 * seed}}})}};
    return folder.with(name, json{{"method", "paper"}, {"runs", json::array({run})}}.dump());
  };
  const std::string out = folder.file("all.json");
  const Called merged =
      orthonav({"study", "merge", shard("b.json", 2), shard("a.json", 1), "--json", out});
  ASSERT_EQ(merged.code, 0) << merged.err;
  const json study = json::parse(content_of(out));
  EXPECT_EQ(study["operations"], 2);
  EXPECT_EQ(study["runs"][0]["seed"], 1);
  EXPECT_DOUBLE_EQ(study["table"][2]["mean"], 1.5);
}

}  // namespace
}  // namespace orthonav::test
