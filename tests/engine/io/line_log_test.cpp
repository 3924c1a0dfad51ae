#include "engine/io/line_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>
#include <csignal>

#include "tests/support/file_calls.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine {
namespace {

using orthonav::test::content_of;
using orthonav::test::error_of;
using orthonav::test::FileCalls;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using orthonav::test::wait_until;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(LineLog, LiesInTheOpenWhileItGrowsAndIsNamedAtItsEnd) {
  const TemporaryFolder folder;
  const std::string path = folder.file("session.orthonav");
  auto log = LineLog::create(path).value();
  log->add("one");
  log->add("two", LineLog::Keep::kDurable);
  EXPECT_TRUE(wait_until([&] { return content_of(path + ".part") == "one\ntwo\n"; }));
  EXPECT_FALSE(std::filesystem::exists(path));
  ASSERT_TRUE(log->finish().ok());
  EXPECT_FALSE(log->finish().ok()) << "finished twice";
  EXPECT_EQ(content_of(path), "one\ntwo\n");
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_EQ(log->earlier_kept_as(), "");
}

TEST(LineLog, StaysUnfinishedWithoutAnEndAndGoesWhenItHoldsItsFirstLineAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("session.orthonav");
  LineLog::create(path).value()->add("header");
  EXPECT_EQ(folder.count(), 0u);
  {
    auto log = LineLog::create(path).value();
    log->add("header");
    log->add("something");
  }
  EXPECT_EQ(content_of(path + ".part"), "header\nsomething\n");
}

TEST(LineLog, OverwritesNeitherAFinishedOneNorOneThatWasCutOff) {
  const TemporaryFolder folder;
  const std::string path = folder.file("session.orthonav");
  std::ignore = folder.with("session.orthonav", "finished\n");
  std::ignore = folder.with("session.orthonav.part", "cut off\n");
  auto log = LineLog::create(path).value();
  EXPECT_EQ(content_of(path), "finished\n") << "until the new one has its end";
  EXPECT_EQ(content_of(folder.file("session-1.orthonav")), "cut off\n");
  log->add("new");
  ASSERT_TRUE(log->finish().ok());
  EXPECT_EQ(content_of(path), "new\n");
  EXPECT_EQ(content_of(folder.file("session-2.orthonav")), "finished\n");
  EXPECT_THAT(log->earlier_kept_as(), HasSubstr("session-1.orthonav, "));
  EXPECT_THAT(log->earlier_kept_as(), EndsWith("session-2.orthonav"));
  EXPECT_EQ(folder.count(), 3u);
}

TEST(LineLog, LeavesOneThatIsBeingWrittenAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("session.orthonav");
  auto log = LineLog::create(path).value();
  const auto second = LineLog::create(path);
  ASSERT_FALSE(second.ok());
  EXPECT_THAT(second.error().message,
              HasSubstr("session.orthonav.part: is being written by another process"));
}

TEST(LineLog, RefusesAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  EXPECT_THAT(LineLog::create(folder.file("none/a.log")).error().message,
              HasSubstr("No such file or directory"));
}

TEST(LineLog, IsDurableInTheOrderThatACrashNeeds) {
  const TemporaryFolder folder;
  std::ignore = folder.with("a.log", "finished\n");
  std::ignore = folder.with("a.log.part", "cut off\n");
  const FileCalls calls(folder.path().string());
  auto log = LineLog::create(folder.file("a.log")).value();
  log->add("one");
  log->add("two", LineLog::Keep::kDurable);
  ASSERT_TRUE(is_ok(log->finish()));
  EXPECT_THAT(FileCalls::made(),
              ElementsAre("rename a.log.part a-1.log", "fsync .", "fsync .", "write a.log.part",
                          "write a.log.part", "fdatasync a.log.part", "fsync a.log.part",
                          "rename a.log a-1.log", "rename a.log a-2.log", "fsync .",
                          "rename a.log.part a.log", "fsync ."))
      << "each name is durable before another file takes it";
}

TEST(LineLog, TellsOfASyncThatFailedAndTriesNoneAfterIt) {
  const TemporaryFolder folder;
  const FileCalls calls(folder.path().string());
  auto log = LineLog::create(folder.file("a.log")).value();
  FileCalls::fail_next("fdatasync a.log.part", EIO);
  log->add("one", LineLog::Keep::kDurable);
  log->add("two", LineLog::Keep::kDurable);
  EXPECT_EQ(error_of(log->finish()),
            "not every line may outlast a loss of power: " + folder.file("a.log.part") +
                ": cannot be written: Input/output error");
  EXPECT_THAT(FileCalls::made(),
              ElementsAre("fsync .", "write a.log.part", "fdatasync a.log.part", "write a.log.part",
                          "rename a.log.part a.log", "fsync ."))
      << "the disk is well again, but what it dropped is not known";
  EXPECT_EQ(content_of(folder.file("a.log")), "one\ntwo\n");
}

TEST(LineLog, TellsOfTheLastSyncAndOfANameThatIsNotDurable) {
  const TemporaryFolder folder;
  const FileCalls calls(folder.path().string());
  for (const char* call : {"fsync a.log.part", "fsync ."}) {
    auto log = LineLog::create(folder.file("a.log")).value();
    log->add("one");
    FileCalls::fail_next(call, EIO);
    EXPECT_THAT(error_of(log->finish()), EndsWith("cannot be written: Input/output error")) << call;
  }
}

/// A failing sync must not prevent a journal that can still be written.
TEST(LineLog, TellsAtItsEndThatItsNewNameIsNotDurable) {
  const TemporaryFolder folder;
  for (const char* earlier : {"", "cut off\n"}) {
    if (*earlier != '\0') {
      std::ignore = folder.with("a.log.part", earlier);
    }
    const FileCalls calls(folder.path().string());
    FileCalls::fail_next("fsync .", EIO);
    auto log = LineLog::create(folder.file("a.log")).value();
    log->add("one");
    EXPECT_EQ(error_of(log->finish()),
              "its name may not outlast a loss of power: " + folder.path().string() +
                  ": cannot be written: Input/output error");
    EXPECT_EQ(content_of(folder.file("a.log")), "one\n");
  }
}

TEST(LineLog, TakesNoNameWhoseEarlierOwnerIsNotDurableElsewhere) {
  const TemporaryFolder folder;
  std::ignore = folder.with("a.log", "finished\n");
  const FileCalls calls(folder.path().string());
  auto log = LineLog::create(folder.file("a.log")).value();
  log->add("one");
  FileCalls::fail_next("fsync .", EIO);
  EXPECT_THAT(error_of(log->finish()), EndsWith("cannot be written: Input/output error"));
  EXPECT_EQ(content_of(folder.file("a-1.log")), "finished\n");
  EXPECT_EQ(content_of(folder.file("a.log.part")), "one\n");
}

/// A line for which the disk had no room is reported, and damages no other.
TEST(LineLogDeathTest, KeepsWholeLinesOnAFullDisk) {
  const TemporaryFolder folder;
  const std::string path = folder.file("session.orthonav");
  const auto fill = [&path] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit few_bytes{10, RLIM_INFINITY};
    const rlimit any{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &few_bytes);
    auto log = LineLog::create(path).value();
    log->add("header");
    log->add("too long for it");
    log->add("ok");
    const Status end = log->finish();
    setrlimit(RLIMIT_FSIZE, &any);
    std::fprintf(stderr, "%s\n", end.ok() ? "well" : end.error().message.c_str());
    std::_Exit(end.ok() ? 0 : 1);
  };
  EXPECT_EXIT(fill(), ::testing::ExitedWithCode(1), "not every line could be written: .*File too");
  EXPECT_EQ(content_of(path), "header\nok\n");
}

}  // namespace
}  // namespace orthonav::engine
