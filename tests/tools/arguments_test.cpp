#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "tests/tools/command_line.h"

namespace orthonav::test::arguments_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// What is wrong in the command line, in one line that names the word.
void expect_one_line(const std::vector<std::string>& arguments, const std::string& word) {
  const Called called = orthonav(arguments);
  EXPECT_EQ(called.code, 2) << word;
  EXPECT_THAT(called.out, IsEmpty());
  EXPECT_THAT(called.err, AllOf(StartsWith("orthonav: "), HasSubstr(word)));
  EXPECT_EQ(std::count(called.err.begin(), called.err.end(), '\n'), 1) << called.err;
}

TEST(CommandLine, NamesTheWordThatIsWrongInOneLine) {
  expect_one_line({}, "a command is required");
  expect_one_line({"fly"}, "unknown command: fly");
  expect_one_line({"golden", "burn"}, "unknown command: burn (see orthonav golden --help)");
  expect_one_line({"demo", "--nonsense"}, "--nonsense");
  expect_one_line({"demo", "--fast", "--realtime"}, "--realtime");
  expect_one_line({"doctor", "more"}, "more");
  expect_one_line({"rod"}, "--heads is required");
  expect_one_line({"study", "merge"}, "FILE is required");
  expect_one_line({"register", "--model", "m", "--points", "p", "--units", "inch"},
                  "--units: inch is not one of mm, m");
}

TEST(CommandLine, TakesDecimalNumbersInTheirRangesAndNothingElse) {
  for (const std::string seed :
       {"-1", "99999999999999999999", "0x10", "", "1e3", "1.5", " 1", "+1"}) {
    expect_one_line({"demo", "--seed", seed}, "--seed: \"" + seed + "\" must be a whole number");
  }
  for (const std::string frames : {"-3", "0x1", "99999999999999999999", "", "many"}) {
    expect_one_line({"run", "--frames", frames}, "--frames: \"" + frames + "\" must be");
  }
  expect_one_line({"demo", "--threads", "3"}, "from 1 to 2");
  expect_one_line({"study", "--jobs", "-1"}, "--jobs: \"-1\"");
  expect_one_line({"track", "r", "--tools", "t", "--csv", "c", "--full-search-every", "0"}, "1000");
  expect_one_line({"detect", "i", "--max-hamming", "3"}, "from 0 to 2");
  expect_one_line({"detect", "i", "--decimate", "inf"}, "--decimate: \"inf\"");
  expect_one_line({"rod", "--heads", "h", "--diameter-mm", "0x6"}, "--diameter-mm: \"0x6\"");
}

TEST(CommandLine, NamesOptionsThatNoHelpShows) {
  expect_one_line({"demo", "--pace", "5"},
                  "orthonav: --pace: \"5\" must be a number from 0.5 to 4");
  expect_one_line({"preview", "--pace", "x"}, "orthonav: --pace: \"x\" must be a number");
  expect_one_line({"doctor", "--root"}, "orthonav: --root: 1 required");
}

TEST(CommandLine, TakesNoEmptyNameForADefault) {
  expect_one_line({"demo", "--case", ""}, "--case: must not be empty");
  expect_one_line({"run", "--out", ""}, "--out: must not be empty");
  expect_one_line({"study", "--cases", ""}, "--cases: must not be empty");
}

TEST(CommandLine, LeavesNothingWhenItIsRefusedHalfWay) {
  const ScratchFolder folder;
  expect_one_line({"golden", "render", "--out", folder.file("a/b"), "--device", "no such device"},
                  "no such device");
  const std::string file = folder.with("file", "");
  expect_one_line({"run", "--record", folder.file("recording"), "--out", file + "/x"}, "--out");
  expect_one_line({"demo", "--out", folder.file("out"), "--record", file + "/x"}, "/x");
  expect_one_line({"study", "--runs", "1", "--json", folder.file("no/s.json")}, "s.json");
  EXPECT_THAT(folder.names(), ::testing::ElementsAre("file"));
}

/// Runs with standard output going to a device that is always full.
int code_with_full_output(const char* argument) {
  const pid_t child = fork();
  if (child == 0) {
    const int full = open("/dev/full", O_WRONLY);
    const int nothing = open("/dev/null", O_WRONLY);
    if (full < 0 || dup2(full, STDOUT_FILENO) < 0 || dup2(nothing, STDERR_FILENO) < 0) {
      _exit(126);
    }
    execl(ORTHONAV_COMMAND, ORTHONAV_COMMAND, argument, nullptr);
    _exit(127);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(CommandLine, SaysThatItsResultsCouldNotBeWritten) {
  EXPECT_EQ(code_with_full_output("doctor"), 2);
  EXPECT_EQ(code_with_full_output("--help"), 2);
  EXPECT_EQ(orthonav({"--help"}).code, 0);
}

}  // namespace
}  // namespace orthonav::test::arguments_test
