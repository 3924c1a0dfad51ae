#include "engine/io/record_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "engine/io/posix_env.h"
#include "tests/support/is_ok.h"
#include "tests/support/memory_env.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine {
namespace {

using orthonav::test::content_of;
using orthonav::test::is_ok;
using orthonav::test::MemoryEnv;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;

std::vector<std::string> payloads_of(const std::vector<Record>& records) {
  std::vector<std::string> payloads;
  for (const Record& record : records) {
    payloads.push_back(record.payload);
  }
  return payloads;
}

TEST(RecordLog, GoesOnWhereItWasLeft) {
  const TemporaryFolder folder;
  const std::string path = folder.file("operation.resume");
  PosixEnv env;
  {
    auto log = RecordLog::create(env, path, {1, 1, "begin"}).value();
    ASSERT_TRUE(is_ok(log->append({2, 1, "one"})));
    EXPECT_EQ(log->durable(), 2u);
  }
  {
    auto again = RecordLog::reopen(env, path).value();
    EXPECT_EQ(payloads_of(again.records), (std::vector<std::string>{"begin", "one"}));
    ASSERT_TRUE(is_ok(again.log->append({2, 1, "two"})));
    EXPECT_EQ(again.log->durable(), 3u);
  }
  const auto read = read_log(env, path);
  EXPECT_EQ(payloads_of(read->records), (std::vector<std::string>{"begin", "one", "two"}));
  EXPECT_EQ(folder.count(), 1u);
}

TEST(RecordLog, KeepsEarlierOnesUnderOtherNames) {
  const TemporaryFolder folder;
  const std::string path = folder.file("operation.resume");
  PosixEnv env;
  for (const char* name : {"a", "b", "c"}) {
    ASSERT_TRUE(is_ok(RecordLog::create(env, path, {1, 1, name})));
  }
  EXPECT_EQ(payloads_of(read_log(env, folder.file("operation-1.resume"))->records).front(), "a");
  EXPECT_EQ(payloads_of(read_log(env, folder.file("operation-2.resume"))->records).front(), "b");
  EXPECT_EQ(payloads_of(read_log(env, path)->records).front(), "c");
  EXPECT_EQ(newest_log(env, path).value(), path);
  ASSERT_TRUE(is_ok(env.remove(path)));
  EXPECT_EQ(newest_log(env, path).value(), folder.file("operation-2.resume"));
}

TEST(RecordLog, KeepsATornEndBesideBeforeItIsCutOff) {
  const TemporaryFolder folder;
  const std::string path = folder.file("operation.resume");
  PosixEnv env;
  ASSERT_TRUE(is_ok(RecordLog::create(env, path, {1, 1, "begin"})));
  const std::string whole = content_of(path);
  std::ignore = folder.with("operation.resume", whole + "torn");
  auto again = RecordLog::reopen(env, path).value();
  EXPECT_EQ(again.dropped_bytes, 4u);
  EXPECT_EQ(content_of(path), whole);
  EXPECT_EQ(content_of(path + ".dropped"), "torn");
  ASSERT_TRUE(is_ok(again.log->append({1, 1, "next"})));
  EXPECT_EQ(read_log(env, path)->records.size(), 2u);
}

TEST(RecordLog, RefusesWhatIsNoneInOneLine) {
  const TemporaryFolder folder;
  PosixEnv env;
  const auto missing = RecordLog::reopen(env, folder.file("operation.resume"));
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(missing.error().message, HasSubstr("operation.resume: cannot be read"));
  const auto other =
      RecordLog::reopen(env, folder.with("operation.resume", "something else, longer"));
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().message, HasSubstr("is not a file of records"));
  const auto empty = RecordLog::reopen(env, folder.with("operation.resume", ""));
  ASSERT_FALSE(empty.ok());
  EXPECT_THAT(empty.error().message, HasSubstr("holds no whole record"));
  EXPECT_THAT(
      RecordLog::create(env, folder.file("none/operation.resume"), {1, 1, ""}).error().message,
      HasSubstr("No such file or directory"));
}

TEST(RecordLog, TriesASyncThatFailedNeverAgain) {
  MemoryEnv env;
  auto log = RecordLog::create(env, "out/operation.resume", {1, 1, "begin"}).value();
  ASSERT_TRUE(is_ok(log->append({2, 1, "one"})));
  env.fail_at(env.calls().size() + 1, EIO, false);
  const Status lost = log->append({2, 1, "two"});
  ASSERT_FALSE(lost.ok());
  EXPECT_EQ(lost.error().message, "out/operation.resume: cannot be written: Input/output error");
  const std::size_t calls = env.calls().size();
  const Status after = log->append({2, 1, "three"});
  ASSERT_FALSE(after.ok()) << "the disk is well again, but what was written is not known";
  EXPECT_EQ(after.error().message, lost.error().message);
  EXPECT_EQ(env.calls().size(), calls) << "nothing was tried";
  EXPECT_EQ(log->durable(), 2u);
}

TEST(FolderLock, IsHeldByOneAlone) {
  const TemporaryFolder folder;
  PosixEnv env;
  {
    const auto lock = env.lock(folder.path().string());
    ASSERT_TRUE(is_ok(lock));
    const auto second = env.lock(folder.path().string());
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().message, folder.path().string() + ": is in use by another operation");
    EXPECT_EQ(second.error().code, ErrorCode::kUnavailable);
  }
  EXPECT_TRUE(is_ok(env.lock(folder.path().string())));
}

}  // namespace
}  // namespace orthonav::engine
