// A terminal that nobody reads, or that goes away: the parts. Whole commands: faults/.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "tests/support/wait_until.h"
#include "tests/tools/full_pipe.h"
#include "tools/orthonav/shared/stop_signals.h"
#include "tools/orthonav/shared/unblocked_output.h"

namespace orthonav::tools::terminal_test {
namespace {

using test::FullPipe;
using test::wait_until;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(UnblockedOutput, DropsTheOldestAndSaysSoOnceItIsRead) {
  FullPipe terminal;
  UnblockedOutput output(terminal.writer(), UnblockedOutput::Closes::kNever);
  constexpr int kLines = 2000;
  const std::string rest(60, '.');
  for (int i = 0; i < kLines; ++i) {
    output.add("line " + std::to_string(i) + rest + "\n");
  }
  const std::int64_t lost = output.lost();
  EXPECT_GT(lost, 500);
  EXPECT_LT(lost, kLines - 500) << "64 KiB are kept";
  output.add("the end\n");
  const std::string text = terminal.read_until("the end\n");
  EXPECT_THAT(text, HasSubstr("orthonav: missing here, since they could not be written in time: "));
  EXPECT_THAT(text, HasSubstr("line 1999" + rest + "\nthe end\n"));
  EXPECT_THAT(text, Not(HasSubstr("line 500.")));
  EXPECT_TRUE(output.settle());
}

TEST(UnblockedOutput, KeepsOnlyTheNewestDrawingOfALine) {
  FullPipe terminal;
  UnblockedOutput output(terminal.writer(), UnblockedOutput::Closes::kNever);
  output.add("first\n");
  for (int i = 0; i < 5000; ++i) {
    output.add("\r\033[K[#####.....] " + std::to_string(i) + " %");
  }
  output.add("\nlast\n");
  const std::string text = terminal.read_until("last\n");
  EXPECT_THAT(text, EndsWith("4999 %\nlast\n"));
  EXPECT_THAT(text, Not(HasSubstr("4998 %")));
  EXPECT_EQ(output.lost(), 0);
}

TEST(UnblockedOutput, CountsWhatNobodyCanReadAnyMore) {
  const StopSignals ignores_broken_pipes;
  FullPipe terminal;
  terminal.close_reader();
  UnblockedOutput output(terminal.writer(), UnblockedOutput::Closes::kNever);
  output.add("one\n");
  EXPECT_TRUE(output.settle());
  EXPECT_EQ(output.lost(), 1);
  EXPECT_EQ(output.error_number(), EPIPE);
}

TEST(UnblockedStandardError, TakesWhateverIsPrintedAndComesToItsEnd) {
  FullPipe terminal;
  const int before = ::dup(STDERR_FILENO);
  ::dup2(terminal.writer(), STDERR_FILENO);
  {
    const UnblockedStandardError unblocked;
    std::fprintf(stderr, "%s %d\n", "printed", 1);
    std::cerr << "streamed " << 2 << "\n" << std::flush;
  }
  const std::string text = terminal.read_until("streamed 2\n");
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  EXPECT_THAT(text, AllOf(HasSubstr("printed 1\n"), HasSubstr("streamed 2\n")));
}

/// Whether a signal was sent and has not been taken yet.
bool is_pending(int signal) {
  sigset_t pending{};
  return ::sigpending(&pending) == 0 && sigismember(&pending, signal) == 1;
}

void send_and_let_it_be_taken(int signal) {
  ::kill(::getpid(), signal);
  ASSERT_TRUE(wait_until([&] { return !is_pending(signal); }));
}

TEST(StopSignals, ManyHangUpsAndATerminationWithThemOnlyAsk) {
  StopSignals signals;
  int asked = 0;
  signals.on_stop([&] { ++asked; });
  for (const int signal : {SIGHUP, SIGHUP, SIGTERM, SIGHUP}) {
    send_and_let_it_be_taken(signal);
  }
  ASSERT_TRUE(wait_until([&] { return signals.caught().has_value(); }));
  EXPECT_EQ(signals.caught(), "SIGHUP");
  signals.on_stop(nullptr);
  EXPECT_EQ(asked, 1);
}

TEST(StopSignals, LeaveHangUpsIgnoredUnderNohup) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  {
    StopSignals signals;
    signals.let_finish();
    ::kill(::getpid(), SIGHUP);
    send_and_let_it_be_taken(SIGTERM);
    ASSERT_TRUE(wait_until([&] { return signals.caught().has_value(); }));
    EXPECT_EQ(signals.caught(), "SIGTERM");
  }
  std::signal(SIGHUP, before);
}

}  // namespace
}  // namespace orthonav::tools::terminal_test
