#include "engine/io/record_writer.h"

#include <gtest/gtest.h>

#include <cerrno>

#include "engine/io/posix_env.h"
#include "tests/support/is_ok.h"
#include "tests/support/memory_env.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine {
namespace {

using orthonav::test::error_of;
using orthonav::test::is_ok;
using orthonav::test::MemoryEnv;
using orthonav::test::TemporaryFolder;
using orthonav::test::wait_until;

constexpr std::uint64_t kRecords = 200;

TEST(RecordWriter, WritesInOrderOnAThreadOfItsOwn) {
  const TemporaryFolder folder;
  const std::string path = folder.file("operation.resume");
  PosixEnv env;
  {
    RecordWriter writer(RecordLog::create(env, path, {1, 1, "0"}).value(),
                        RecordWriter::Waits::kNot);
    for (std::uint64_t i = 1; i < kRecords; ++i) {
      EXPECT_EQ(writer.add({1, 1, std::to_string(i)}), i + 1);
      EXPECT_LE(writer.durable(), i + 1);
    }
    ASSERT_TRUE(is_ok(writer.finish()));
    EXPECT_EQ(writer.durable(), kRecords);
    writer.add({1, 1, std::to_string(kRecords)});
  }
  const auto read = read_log(env, path);
  ASSERT_EQ(read->records.size(), kRecords + 1) << "what was added last is written too";
  for (std::uint64_t i = 0; i <= kRecords; ++i) {
    EXPECT_EQ(read->records[i].payload, std::to_string(i));
  }
}

TEST(RecordWriter, TellsAFailureToWhoeverAsks) {
  MemoryEnv env;
  auto log = RecordLog::create(env, "out/operation.resume", {1, 1, ""}).value();
  env.fail_at(env.calls().size() + 1, EIO, false);
  RecordWriter writer(std::move(log), RecordWriter::Waits::kNot);
  EXPECT_FALSE(writer.failed());
  writer.add({1, 1, "lost"});
  EXPECT_TRUE(wait_until([&] { return writer.failed(); }));
  writer.add({1, 1, "not tried"});
  EXPECT_EQ(error_of(writer.finish()),
            "out/operation.resume: cannot be written: Input/output error");
  EXPECT_EQ(writer.durable(), 1u);
}

TEST(RecordWriter, WaitsForTheDiskWhereItIsAskedTo) {
  MemoryEnv env;
  RecordWriter writer(RecordLog::create(env, "out/operation.resume", {1, 1, ""}).value(),
                      RecordWriter::Waits::kUntilDurable);
  for (std::uint64_t number = 2; number < kRecords; ++number) {
    writer.add({1, 1, ""});
    ASSERT_EQ(writer.durable(), number);
  }
}

}  // namespace
}  // namespace orthonav::engine
