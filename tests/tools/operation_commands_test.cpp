#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

#include "tests/tools/command_line.h"

namespace orthonav::test::operation_commands_test {
namespace {

using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Exit code 2, nothing on standard output, one line that says why.
void expect_refusal(const Called& called, const std::string& reason) {
  EXPECT_EQ(called.code, 2) << called.err;
  EXPECT_THAT(called.out, IsEmpty());
  EXPECT_THAT(called.err, HasSubstr(reason));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
}

TEST(RunCommand, RefusesItsArgumentsBeforeItPreparesAnything) {
  expect_refusal(orthonav({"run", "--headset", "sim:?sed=3", "--case", "/none"}),
                 "unknown key \"sed\"");
  expect_refusal(orthonav({"run", "--tools", "none.json", "--case", "/none"}), "none.json");
  expect_refusal(orthonav({"run", "--screws", "none.json", "--case", "/none"}), "none.json");
}

TEST(DemoCommand, RefusesWhatItCannotDoAndLeavesNothing) {
  const ScratchFolder folder;
  const std::string out = folder.file("out");
  expect_refusal(orthonav({"demo", "--out", out, "--method", "nearest"}),
                 "nearest: unknown (available: best, paper)");
  expect_refusal(orthonav({"demo", "--out", out, "--case", folder.file("none")}), "none");
  expect_refusal(orthonav({"demo", "--out", out, "--levels", "L5,T1"}),
                 "no level 'T1' (it has: L1, L2, L3, L4, L5)");
  expect_refusal(orthonav({"demo", "--out", out, "--levels", "L5,L5"}), "named twice");
  expect_refusal(orthonav({"demo", "--out", out, "--device", "no such device"}), "no such device");
  expect_refusal(orthonav({"demo", "--out", out, "--instrument", "saw"}),
                 "--instrument: instrument 'saw': unknown");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(DemoCommand, RefusesAFileInThePlaceOfItsFolder) {
  const ScratchFolder folder;
  const std::string file = folder.with("out", "mine");
  EXPECT_EQ(orthonav({"demo", "--out", file}).code, 2);
  EXPECT_EQ(content_of(file), "mine");
}

TEST(DemoCommand, ComesToItsEndWithEveryResultAndNothingOfAnEarlierRun) {
  const ScratchFolder folder;
  const std::string out = folder.file("out");
  std::filesystem::create_directories(out);
  for (const char* stale : {"12-done.png", "report.json", "mine-01-setup.png", "notes.txt"}) {
    std::ignore = folder.with("out/" + std::string(stale), "of an earlier run");
  }
  const Called demo =
      orthonav({"demo", "--levels", "L5", "--pace", "4", "--seed", "10", "--out", out, "--json"});
  ASSERT_EQ(demo.code, 0) << demo.err;
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    names.insert(entry.path().filename().string());
  }
  for (const char* name : {"report.html", "report.json", "timing.json", "operation.resume",
                           "operation.mp4", "01-setup.png"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
    EXPECT_GT(std::filesystem::file_size(out + "/" + name), 100u) << name;
  }
  const auto shows = [&names](const std::string& step) {
    return std::any_of(names.begin(), names.end(), [&step](const std::string& name) {
      return name.size() == step.size() + 7 && name.ends_with("-" + step + ".png");
    });
  };
  for (const char* step : {"digitize-L5", "guide-L5-left", "guide-L5-right", "done"}) {
    EXPECT_TRUE(shows(step)) << step;
  }
  EXPECT_FALSE(shows("rod-left")) << "one level has no rod";
  EXPECT_EQ(names.count("12-done.png"), 0u) << "a picture of the run before";
  EXPECT_EQ(content_of(out + "/mine-01-setup.png"), "of an earlier run") << "not ours to remove";
  EXPECT_EQ(names.count("notes.txt"), 1u);
  for (const std::string& name : names) {
    EXPECT_THAT(name, Not(HasSubstr(".part")));
  }

  EXPECT_EQ(content_of(out + "/report.json"), demo.out);
  const json report = json::parse(demo.out);
  EXPECT_EQ(report["completed"], true);
  EXPECT_FALSE(report.contains("why_not"));
  EXPECT_GT(report["levels"][0]["screws"][1]["angle_error_deg"].get<double>(), 0.0);
  EXPECT_GT(json::parse(content_of(out + "/timing.json"))["draw_wall"]["count"], 30);
  const json registration = report["levels"][0]["registration"];
  EXPECT_EQ(registration["accepted"], true);
  EXPECT_EQ(registration["screws"].size(), 2u);
  EXPECT_EQ(report["rod"], json::object());
  EXPECT_GT(registration["noise_mm"].get<double>(), 0.0);
  const std::string page = content_of(out + "/report.html");
  EXPECT_THAT(page, HasSubstr("Registration of L5"));
  EXPECT_THAT(page, HasSubstr("aria-label=\"from above\""));
  EXPECT_THAT(page, HasSubstr("src=\"operation.mp4\" poster=\"data:image/png;base64,"));
  EXPECT_THAT(page, ContainsRegex("date <b>20[0-9][0-9]-[0-9][0-9]-[0-9][0-9] "));
  EXPECT_THAT(page, HasSubstr("Operation completed"));
  EXPECT_THAT(page, ContainsRegex("\"name\":\"good below 2.0[^\"]*\",\"y\":2.0"));
  EXPECT_THAT(demo.out, Not(HasSubstr("date"))) << "report.json is the same from day to day";
  EXPECT_EQ(report["levels"][0]["screws"][0]["done"], true);
  EXPECT_GT(report["levels"][0]["screws"][0]["planned"]["diameter_mm"].get<double>(), 3.0);
  EXPECT_GT(report["levels"][0]["screws"][0]["planned"]["length_mm"].get<double>(), 20.0);
  // The log tells the same: of all but the truth and the bones.
  const Called again = orthonav({"report", out, "--out", folder.file("again.html"), "--json"});
  ASSERT_EQ(again.code, 0) << again.err;
  const json told = json::parse(again.out);
  EXPECT_GT(told["session"]["records"], 50);
  for (const char* key : {"completed", "method", "case", "seed", "common_errors"}) {
    EXPECT_EQ(told[key], report[key]) << key;
  }
  for (const char* key :
       {"accepted", "attempts", "rmse_mm", "predicted_tre_mm", "points", "digitization_s"}) {
    EXPECT_EQ(told["levels"][0][key], report["levels"][0][key]) << key;
  }
  // As far off as each was when it was touched; the session weighs them by what came after, and it
  // goes on to learn about the cameras.
  EXPECT_EQ(told["levels"][0]["check_points_mm"].size(),
            report["levels"][0]["check_points_mm"].size());
  EXPECT_EQ(told["calibration"]["tags"].size(), report["calibration"]["tags"].size());
  for (const std::size_t screw : {0U, 1U}) {
    for (const char* key : {"done", "tracked", "executed", "wire", "redone"}) {
      EXPECT_EQ(told["levels"][0]["screws"][screw][key], report["levels"][0]["screws"][screw][key])
          << key;
    }
  }
  EXPECT_THAT(content_of(out + "/operation.mp4"), HasSubstr("ftyp"));
  const ScratchFolder other;
  const Called run =
      orthonav({"run", "--levels", "L5", "--frames", "2", "--json", "--out", other.file("out")});
  EXPECT_EQ(json::parse(run.out)["common_errors"], report["common_errors"]);
  EXPECT_NEAR(registration["common_sd_mm"]["cameras"].get<double>(), 0.46, 0.005);
}

TEST(RunCommand, EndsAfterTheFramesAskedForAndRecordsThem) {
  const ScratchFolder folder;
  const std::string recording = folder.file("recording");
  const std::string out = folder.file("out");
  const Called live =
      orthonav({"run", "--headset", "sim:?seed=3", "--no-reference", "--levels", "L5", "--frames",
                "6", "--json", "--record", recording, "--out", out});
  ASSERT_EQ(live.code, 0) << live.err;
  const json report = json::parse(live.out);
  EXPECT_EQ(report["method"], "best");
  EXPECT_EQ(report["frames"]["displayed"], 6);
  EXPECT_EQ(report["levels"][0]["label"], "L5");
  EXPECT_EQ(report["levels"][0]["accepted"], false);
  EXPECT_FALSE(report["levels"][0].contains("points")) << "none were registered: no 0 for a mean";
  EXPECT_EQ(report["seed"], 3) << "of the headset that was opened";
  EXPECT_EQ(report["why_not"], "ended at setup of L5");

  // Without a limit the answer is no: the recording ends before the operation does.
  const Called again = orthonav(
      {"run", "--headset", "replay:" + recording, "--levels", "L5", "--json", "--out", out});
  EXPECT_EQ(again.code, 1) << again.err;
  EXPECT_EQ(json::parse(again.out)["frames"]["displayed"], 6);
  EXPECT_FALSE(json::parse(again.out).contains("seed")) << "a recording has none";

  // What all strokes share: the room's, and the same assumed where nobody says.
  const json room = report["common_errors"];
  const json assumed = json::parse(again.out)["common_errors"];
  for (const auto& [name, key] : {std::pair("tip", "sd_mm"), std::pair("cameras", "sd_mm"),
                                  std::pair("map_drift", "sd_mm_per_sqrt_s")}) {
    EXPECT_EQ(room[name]["source"], "simulated room") << name;
    EXPECT_EQ(assumed[name]["source"], "assumed") << name;
    EXPECT_GT(room[name][key], 0.1) << name;
    EXPECT_NEAR(room[name][key].get<double>(), assumed[name][key].get<double>(), 0.005) << name;
  }
}

TEST(RunCommand, HasThePatientReferenceUnlessItIsDeclined) {
  const ScratchFolder folder;
  const std::string out = folder.file("out");
  for (const auto& [flags, has] : std::vector<std::pair<std::vector<std::string>, bool>>{
           {{}, true}, {{"--no-reference"}, false}, {{"--as-published"}, false}}) {
    std::vector<std::string> all = {"run",      "--headset", "sim:?perfect", "--levels", "L4",
                                    "--frames", "1",         "--json",       "--out",    out};
    all.insert(all.end(), flags.begin(), flags.end());
    const Called called = orthonav(all);
    ASSERT_EQ(called.code, 0) << called.err;
    EXPECT_EQ(json::parse(called.out).value("patient_reference", false), has)
        << testing::PrintToString(flags);
  }
}

TEST(RunCommand, CountsWithTheCommonErrorsThatAreGiven) {
  const ScratchFolder folder;
  const std::string out = folder.file("out");
  const Called given =
      orthonav({"run", "--headset", "sim:?seed=3", "--levels", "L5", "--frames", "2", "--json",
                "--out", out, "--tip-sd-mm", "1.5", "--map-sd-mm", "0.2"});
  ASSERT_EQ(given.code, 0) << given.err;
  const json errors = json::parse(given.out)["common_errors"];
  EXPECT_EQ(errors["tip"], (json{{"sd_mm", 1.5}, {"source", "given"}}));
  EXPECT_EQ(errors["cameras"]["source"], "simulated room");
  EXPECT_EQ(errors["map"], (json{{"sd_mm", 0.2}, {"source", "given"}}));
  EXPECT_EQ(errors["map_drift"]["sd_mm_per_sqrt_s"], 0.0) << "what is given counts instead";
  const Called told = orthonav({"report", out, "--out", folder.file("again.html"), "--json"});
  EXPECT_EQ(json::parse(told.out)["common_errors"], errors);
  EXPECT_THAT(content_of(out + "/report.html"), HasSubstr("tip 1.50 mm (given), cameras 0.46 mm"));
}

TEST(RunCommand, GoesOnWithTheOperationOfAFolderAndWithNoOther) {
  const ScratchFolder folder;
  const std::string out = folder.file("out");
  expect_refusal(orthonav({"run", "--resume"}), "--resume requires --out");
  expect_refusal(orthonav({"run", "--resume", "--out", folder.file(".")}),
                 "holds no operation.resume, there is no operation to resume");
  const std::vector<std::string> run = {"run",      "--headset", "sim:?seed=3", "--levels", "L5",
                                        "--frames", "6",         "--out",       out};
  ASSERT_EQ(orthonav(run).code, 0);
  const std::string log = content_of(out + "/operation.resume");
  ASSERT_FALSE(log.empty());
  expect_refusal(orthonav({"run", "--headset", "sim:?seed=3", "--levels", "L4", "--frames", "6",
                           "--out", out, "--resume"}),
                 "is of levels L5, not of levels L4");
  expect_refusal(orthonav({"run", "--headset", "sim:?seed=4", "--levels", "L5", "--frames", "6",
                           "--out", out, "--resume"}),
                 "is of the simulated patient 'seed 3', not of 'seed 4'");
  EXPECT_EQ(content_of(out + "/operation.resume"), log) << "whoever is refused changes nothing";
  std::vector<std::string> resume = run;
  resume.emplace_back("--resume");
  const Called resumed = orthonav(resume);
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("resuming " + out + "/operation.resume: case 'phantom'"));
  EXPECT_THAT(resumed.err, HasSubstr("orthonav: placed: no screw"));
  EXPECT_EQ(content_of(out + "/operation.resume").substr(0, log.size()), log)
      << "and goes on with it";
  ASSERT_EQ(orthonav(run).code, 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/operation-1.resume")) << "nothing is overwritten";
}

TEST(RodsOnly, AreRefusedWhereTheyFitNothing) {
  const ScratchFolder folder;
  const std::string rods = folder.file("rods");
  std::filesystem::create_directories(rods);
  std::ignore = folder.with("rods/case.json", R"({"name": "Miller", "levels": []})");
  expect_refusal(orthonav({"run", "--case", rods}),
                 "levels is empty, at least 1 needed, unless rods alone are bent (orthonav run "
                 "--rods-only)");
  expect_refusal(orthonav({"demo", "--case", rods, "--out", folder.file("out")}),
                 "levels is empty, at least 1 needed");
  expect_refusal(orthonav({"demo", "--rods-only", "--case", rods, "--out", folder.file("out")}),
                 "case 'Miller' has no screws, so none stands in the simulated room");
  expect_refusal(orthonav({"run", "--rods-only", "--case", rods}),
                 "case 'Miller' has no screws, so none stands in the simulated room");
  expect_refusal(orthonav({"run", "--rods-only", "--levels", "L5"}),
                 "--levels excludes --rods-only");
  expect_refusal(orthonav({"run", "--rods-only", "--seat-mm", "31"}), "--seat-mm");
}

/// Recorded in the simulated room, then played: as with any device, no case is needed.
TEST(RodsOnly, NeedNoCaseOnAHeadset) {
  const ScratchFolder folder;
  const std::string recording = folder.file("recording");
  const std::string out = folder.file("out");
  const std::vector<std::string> run = {
      "run", "--rods-only", "--headset", "sim:?seed=3", "--json", "--frames", "6", "--out", out};
  std::vector<std::string> recorded = run;
  recorded.insert(recorded.end(), {"--record", recording});
  const Called live = orthonav(recorded);
  ASSERT_EQ(live.code, 0) << live.err;
  EXPECT_EQ(json::parse(live.out)["levels"], json::array());
  EXPECT_EQ(json::parse(live.out)["why_not"], "ended at setup");
  EXPECT_EQ(json::parse(live.out)["case"], "phantom");
  const Called again =
      orthonav({"run", "--rods-only", "--headset", "replay:" + recording, "--json"});
  EXPECT_EQ(again.code, 1) << again.err;
  EXPECT_EQ(json::parse(again.out)["case"], "not stated");
  const std::string page = folder.file("page.html");
  ASSERT_EQ(orthonav({"report", out, "--out", page}).code, 0);
  EXPECT_THAT(content_of(page), HasSubstr("0 rods templated, without a registration"));

  std::vector<std::string> resume = run;
  resume.emplace_back("--resume");
  const Called resumed = orthonav(resume);
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("case 'phantom', rods alone, begun"));
}

TEST(RunCommand, RefusesBadInput) {
  const ScratchFolder folder;
  const std::string out = folder.file("out");
  expect_refusal(orthonav({"run", "--levels", "L5", "--headset", "holo:", "--out", out}),
                 "unknown scheme");
  expect_refusal(orthonav({"run", "--levels", "L5", "--headset", "replay:" + folder.file("none"),
                           "--out", out}),
                 "none");
  expect_refusal(orthonav({"run", "--method", "nearest"}), "nearest: unknown");
  expect_refusal(orthonav({"run", "--levels", "L5", "--tools", folder.with("t.json", "{}")}),
                 "t.json");
}

TEST(StudyCommand, RefusesBadInput) {
  const ScratchFolder folder;
  expect_refusal(orthonav({"study", "--shard", "3/2"}), "--shard 3/2");
  expect_refusal(orthonav({"study", "--shard", "1/2x"}), "--shard 1/2x");
  expect_refusal(orthonav({"study", "--runs", "0"}), "--runs: \"0\"");
  expect_refusal(orthonav({"study", "--cases", folder.file("none")}), "no case.json");
  expect_refusal(orthonav({"study", "merge", folder.with("a.json", "[]")}), "is not a study");
}

}  // namespace
}  // namespace orthonav::test::operation_commands_test
