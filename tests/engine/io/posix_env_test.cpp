#include "engine/io/posix_env.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "engine/io/record_log.h"
#include "tests/support/file_calls.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using orthonav::test::content_of;
using orthonav::test::error_of;
using orthonav::test::FileCalls;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::EndsWith;

/// The calls to the kernel that make a log durable, and their order. The tests of the double show
/// why each is needed (CrashOfALog).
class PosixLog : public ::testing::Test {
 protected:
  std::unique_ptr<RecordLog> created(RecordLog::Earlier earlier = RecordLog::Earlier::kKept) {
    return RecordLog::create(env_, path_, {1, 1, "begin"}, earlier).value();
  }
  TemporaryFolder folder_;
  std::string path_ = folder_.file("a.log");
  PosixEnv env_;
};

TEST_F(PosixLog, IsOnTheDiskBeforeItHasItsName) {
  const FileCalls calls(folder_.path().string());
  std::ignore = created();
  EXPECT_THAT(FileCalls::made(),
              ElementsAre("unlink a.log.new", "write a.log.new", "fsync a.log.new",
                          "rename a.log.new a.log", "fsync ."));
}

TEST_F(PosixLog, MovesAnEarlierOneAsideForGoodFirst) {
  std::ignore = created();
  const FileCalls calls(folder_.path().string());
  std::ignore = created();
  EXPECT_THAT(FileCalls::made(),
              ElementsAre("unlink a.log.new", "write a.log.new", "fsync a.log.new",
                          "rename a.log a-1.log", "fsync .", "rename a.log.new a.log", "fsync ."));
}

TEST_F(PosixLog, SyncsEveryRecord) {
  auto log = created();
  const FileCalls calls(folder_.path().string());
  ASSERT_TRUE(is_ok(log->append({2, 1, "one"})));
  ASSERT_TRUE(is_ok(log->append({2, 1, "two"})));
  EXPECT_THAT(FileCalls::made(),
              ElementsAre("write a.log", "fsync a.log", "write a.log", "fsync a.log"));
}

TEST_F(PosixLog, IsSyncedBeforeItIsGoneOnWith) {
  std::ignore = created();
  std::ignore = folder_.with("a.log", content_of(path_) + "torn");
  const FileCalls calls(folder_.path().string());
  ASSERT_TRUE(is_ok(RecordLog::reopen(env_, path_)));
  EXPECT_THAT(FileCalls::made(),
              ElementsAre("write a.log.dropped", "fsync a.log.dropped", "fsync .", "truncate a.log",
                          "fsync a.log", "fsync ."));
}

TEST_F(PosixLog, TellsOfEachCallThatFails) {
  for (const char* call : {"unlink a.log.new", "write a.log.new", "fsync a.log.new",
                           "rename a.log a-1.log", "rename a.log.new a.log", "fsync ."}) {
    const TemporaryFolder folder;
    std::ignore = folder.with("a.log", "an earlier one");
    const FileCalls calls(folder.path().string());
    FileCalls::fail_next(call, EIO);
    const auto log = RecordLog::create(env_, folder.file("a.log"), {1, 1, "begin"});
    EXPECT_THAT(error_of(log), EndsWith("Input/output error")) << call;
  }
}

TEST_F(PosixLog, WritesNothingAfterASyncThatFailed) {
  auto log = created();
  const FileCalls calls(folder_.path().string());
  FileCalls::fail_next("fsync a.log", EIO);
  EXPECT_EQ(error_of(log->append({2, 1, "one"})),
            path_ + ": cannot be written: Input/output error");
  EXPECT_FALSE(log->append({2, 1, "two"}).ok());
  EXPECT_THAT(FileCalls::made(), ElementsAre("write a.log", "fsync a.log"));
  EXPECT_EQ(log->durable(), 1u);
}

TEST_F(PosixLog, GoesOnAfterAWriteThatASignalInterrupted) {
  auto log = created();
  const FileCalls calls(folder_.path().string());
  FileCalls::fail_next("write a.log", EINTR);
  ASSERT_TRUE(is_ok(log->append({2, 1, "one"})));
  EXPECT_THAT(FileCalls::made(), ElementsAre("write a.log", "write a.log", "fsync a.log"));
  EXPECT_EQ(read_log(env_, path_)->records.size(), 2u);
}

}  // namespace
}  // namespace orthonav::engine
