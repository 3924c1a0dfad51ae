#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/io/posix_env.h"
#include "engine/session/log/logged_operation.h"
#include "tests/support/wait_until.h"
#include "tests/tools/command_line.h"
#include "tools/orthonav/shared/stop_signals.h"

namespace orthonav::tools {
namespace {

using nlohmann::json;
using test::orthonav;
using test::ScratchFolder;
using test::StartedCommand;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A recorded run in the simulated room that would take minutes, with all the files that it leaves.
struct LongRun {
  ScratchFolder folder;
  std::string out = folder.file("out");
  std::string recording = folder.file("recording");
  StartedCommand command{
      {"run", "--headset", "sim:?seed=3", "--levels", "L5", "--out", out, "--record", recording},
      [] { std::signal(SIGHUP, SIG_DFL); }};  // the tests may run under nohup

  /// Whether pairs are being recorded: the file of right images has at least this many bytes.
  bool is_under_way(std::uintmax_t least_bytes = 1) const {
    return test::wait_until([&] {
      std::error_code none;
      const auto bytes = std::filesystem::file_size(recording + ".part/VLC RF.tar", none);
      return !none && bytes >= least_bytes;
    });
  }
};

/// Names that a run gives to files it has not finished.
std::vector<std::string> unfinished_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".") || name.find(".part") != std::string::npos) {
      names.push_back(name);
    }
  }
  return names;
}

void expect_a_whole_end(LongRun& run, const std::string& signal) {
  const test::Called ended = run.command.wait();
  EXPECT_EQ(ended.code, 1) << "the operation is not done: " << ended.err;
  EXPECT_THAT(ended.err, HasSubstr(signal + ": finishing what was begun"));
  EXPECT_THAT(ended.err, HasSubstr("stopped by " + signal + "; kept: " + run.out));
  std::ifstream in(run.out + "/report.json");
  const json report = json::parse(in);
  EXPECT_THAT(report["why_not"].get<std::string>(), StartsWith("stopped by " + signal));
  EXPECT_TRUE(std::filesystem::exists(run.out + "/report.html"));
  engine::PosixEnv env;
  const auto log = engine::LoggedOperation::read(env, run.out + "/operation.resume");
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_TRUE(log->ended && !log->done);
  EXPECT_THAT(log->reason, StartsWith("stopped by " + signal));
  EXPECT_THAT(unfinished_in(run.folder.file("")), ::testing::IsEmpty());
  // The recording is whole: it replays to the pair that was finished.
  const ScratchFolder other;
  const test::Called again = orthonav({"run", "--headset", "replay:" + run.recording, "--levels",
                                       "L5", "--json", "--out", other.file("out")});
  EXPECT_EQ(again.err.find("cut"), std::string::npos) << again.err;
  EXPECT_EQ(json::parse(again.out)["frames"]["displayed"], report["frames"]["displayed"]);
}

TEST(StopSignals, TheFirstFinishesWhatWasBegun) {
  LongRun run;
  ASSERT_TRUE(run.is_under_way());
  run.command.send(SIGINT);
  expect_a_whole_end(run, "SIGINT");
}

TEST(StopSignals, ATerminalThatClosesIsTakenLikeCtrlC) {
  LongRun run;
  ASSERT_TRUE(run.is_under_way());
  run.command.send(SIGHUP);
  expect_a_whole_end(run, "SIGHUP");
}

/// After a signal that can't be caught, the written files are under their temporary names and can
/// be read.
TEST(StopSignals, AKilledRunLeavesALogAndARecordingThatCanBeRead) {
  LongRun run;
  constexpr std::uintmax_t kThreeImages = 3 * 640 * 480;
  ASSERT_TRUE(run.is_under_way(kThreeImages));
  run.command.send(SIGKILL);
  EXPECT_EQ(run.command.wait().code, -1);
  EXPECT_THAT(unfinished_in(run.folder.file("")),
              ::testing::UnorderedElementsAre("recording.part"));
  const std::string page = run.folder.file("page.html");
  const test::Called report = orthonav({"report", run.out, "--out", page});
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_THAT(test::content_of(page), HasSubstr("This session was cut off"));
  const test::Called closed = orthonav({"recording", "repair", run.recording + ".part"});
  EXPECT_EQ(closed.code, 0) << closed.err;
  EXPECT_TRUE(std::filesystem::exists(run.recording));
}

/// At any time: while preparing the model, or during the first operation.
TEST(StopSignals, StopAStudyThatHasNothingYetWithoutAFile) {
  const ScratchFolder folder;
  StartedCommand study({"study", "--levels", "L5", "--json", folder.file("study.json")});
  ASSERT_TRUE(test::wait_until([&] { return study.takes_signals(); }));
  study.send(SIGTERM);
  const test::Called ended = study.wait();
  EXPECT_EQ(ended.code, 128 + SIGTERM);
  EXPECT_THAT(folder.names(), ::testing::IsEmpty());
  EXPECT_THAT(ended.err, HasSubstr("stopped by SIGTERM"));
}

TEST(StopSignals, EndTheStandInWithItsSessions) {
  StartedCommand server({"serve-hl2ss", "--levels", "L5", "--port", "27512"});
  ASSERT_TRUE(
      test::wait_until([&] { return server.err_so_far().find("serving") != std::string::npos; }));
  server.send(SIGINT);
  const test::Called ended = server.wait();
  EXPECT_EQ(ended.code, 128 + SIGINT);
  EXPECT_THAT(ended.err, HasSubstr("stopped by SIGINT after 0 sessions, 0 pairs"));
}

TEST(StopSignalsDeathTest, TheSecondEndsAtOnce) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto two_signals = [] {
    StopSignals signals;
    signals.on_stop([] {});  // a request that is never carried out
    kill(getpid(), SIGINT);
    if (test::wait_until([&] { return signals.caught().has_value(); })) {
      kill(getpid(), SIGTERM);
    }
    pause();
  };
  EXPECT_EXIT(two_signals(), ::testing::ExitedWithCode(128 + SIGTERM),
              "SIGINT: finishing what was begun");
}

TEST(StopSignalsDeathTest, TheFirstEndsACommandAtOnceThatDoesNotFinish) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto one_signal = [] {
    const StopSignals signals;
    kill(getpid(), SIGTERM);
    pause();
  };
  EXPECT_EXIT(one_signal(), ::testing::ExitedWithCode(128 + SIGTERM),
              "stopped by SIGTERM; every file that it wrote is whole");
}

TEST(StopSignals, AskAtOnceWhereTheSignalCameFirst) {
  StopSignals signals;
  signals.let_finish();
  EXPECT_FALSE(signals.caught());
  EXPECT_EQ(signals.exit_code(), 0);
  kill(getpid(), SIGTERM);
  ASSERT_TRUE(test::wait_until([&] { return signals.caught().has_value(); }));
  bool asked = false;
  signals.on_stop([&] { asked = true; });
  EXPECT_TRUE(asked);
  EXPECT_EQ(signals.caught(), "SIGTERM");
  EXPECT_EQ(signals.exit_code(), 128 + SIGTERM);
}

TEST(RunCommand, EndsAfterTheTimeAskedFor) {
  const ScratchFolder folder;
  const auto run = orthonav({"run", "--headset", "sim:?seed=3", "--levels", "L5", "--for", "0.49s",
                             "--json", "--out", folder.file("out")});
  ASSERT_EQ(run.code, 0) << run.err;
  // 30 pairs a second: the first, and 15 intervals.
  EXPECT_EQ(json::parse(run.out)["frames"]["displayed"], 16);
  const auto unitless = orthonav({"run", "--for", "60"});
  EXPECT_EQ(unitless.code, 2);
  EXPECT_THAT(unitless.err, HasSubstr("--for"));
}

}  // namespace
}  // namespace orthonav::tools
