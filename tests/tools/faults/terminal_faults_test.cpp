#include <gmock/gmock.h>
#include <unistd.h>

#include <array>

#include "tests/tools/faults/short_run.h"
#include "tests/tools/full_pipe.h"

namespace orthonav::test::terminal_faults_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(TerminalFaults, OneThatNobodyReadsHoldsUpNothing) {
  ShortRun run;
  const FullPipe terminal;
  const Called called = run.run([&] { ::dup2(terminal.writer(), STDERR_FILENO); });
  EXPECT_EQ(called.code, 0) << "-1: it hung";
  EXPECT_TRUE(all_is_kept(run));
  EXPECT_THAT(called.out, HasSubstr("3 frames displayed"));
  EXPECT_THAT(content_of(run.log()), HasSubstr("3 frames shown"));
}

TEST(TerminalFaults, OneThatIsGoneCostsItsOutputAloneAndTheExitCodeSaysSo) {
  ShortRun run;
  const Called called = run.run([] {
    std::array<int, 2> ends{};
    (void)!::pipe(ends.data());
    ::close(ends[0]);
    ::dup2(ends[1], STDOUT_FILENO);
  });
  EXPECT_EQ(called.code, 2);
  EXPECT_THAT(called.err, HasSubstr("standard output: cannot be written: Broken pipe"));
  EXPECT_TRUE(all_is_kept(run));
}

/// The next file that is opened would get its number.
TEST(TerminalFaults, OneThatWasNeverThereLeavesNoTextInAFile) {
  ShortRun run;
  const Called called = run.run([] { ::close(STDERR_FILENO); });
  EXPECT_EQ(called.code, 0);
  EXPECT_TRUE(all_is_kept(run));
  EXPECT_THAT(content_of(run.log()), HasSubstr("3 frames shown"));
  EXPECT_THAT(content_of(run.log()), Not(HasSubstr(" %  "))) << "a line of progress";
}

}  // namespace
}  // namespace orthonav::test::terminal_faults_test
