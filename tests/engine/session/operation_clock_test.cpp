// The wall clock of the machine is set back while an operation runs: by a time server, or by
// hand.
#include <gmock/gmock.h>

#include <chrono>
#include <ctime>
#include <filesystem>

#include "engine/io/posix_env.h"
#include "engine/session/log/operation_log.h"
#include "tests/support/clock_step.h"
#include "tests/support/is_ok.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/scripted_surgeon.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::operation_clock_test {
namespace {

using test::ClockSetBack;
using test::content_of;
using test::is_ok;
using test::ResumedOperation;
using test::ScriptedSurgeon;
using test::TemporaryFolder;
using test::touched_operation;
using namespace std::chrono_literals;

constexpr int kActs = 12;  // the first screw is guided

std::unique_ptr<OperationLog> begun(Env& env, test::ScriptedOperation& s,
                                    const std::string& folder) {
  auto log = OperationLog::begin(env, folder, test::identity_of(s, true), s.session().levels(),
                                 RecordWriter::Waits::kUntilDurable, RecordLog::Earlier::kKept)
                 .value();
  return log;
}

/// The first half of an operation; before its second quarter the clock is set back by `back`.
void operate_first_half(Env& env, const std::string& folder, std::chrono::seconds back) {
  auto s = touched_operation(true);
  auto log = begun(env, *s, folder);
  s->session().observe(log.get());
  ScriptedSurgeon surgeon(*s);
  for (int i = 0; i < kActs / 2; ++i) {
    surgeon.act();
  }
  const ClockSetBack set_back(back);
  for (int i = 0; i < kActs / 2; ++i) {
    surgeon.act();
  }
}

TEST(ClockOfAnOperation, SetBackAnHourMeanwhileChangesNoByteOfItsLog) {
  const TemporaryFolder steady;
  const TemporaryFolder stepped;
  PosixEnv env;
  {
    const std::time_t before = std::time(nullptr);
    const auto clock_before = std::chrono::system_clock::now();
    const ClockSetBack control(1h);
    ASSERT_LT(std::time(nullptr), before - 3000) << "the clock really is set back";
    ASSERT_LT(std::chrono::system_clock::now(), clock_before - 50min);
  }
  operate_first_half(env, steady.path().string(), 0s);
  operate_first_half(env, stepped.path().string(), 1h);
  EXPECT_GT(content_of(steady / "operation.resume").size(), 1000u);
  EXPECT_EQ(content_of(stepped / "operation.resume"), content_of(steady / "operation.resume"));
}

TEST(ClockOfAnOperation, SetBackBeforeItIsResumedLeavesTheOrderAndTheEnd) {
  const TemporaryFolder folder;
  PosixEnv env;
  operate_first_half(env, folder.path().string(), 0s);
  const ClockSetBack set_back(1h);
  ResumedOperation r(env, true, folder.path().string());
  ASSERT_TRUE(is_ok(r.resumed));
  ScriptedSurgeon(*r.operation).finish();
  ASSERT_TRUE(is_ok(r.log->finish(true, "")));
  const auto log = read_log(env, folder.file("operation.resume"));
  std::uint64_t number = 0;
  for (const Record& record : log->records) {
    EXPECT_EQ(record.number, ++number);
  }
  EXPECT_TRUE(LoggedOperation::from(log->records, "log")->done);
}

/// The last operation is identified by file names, because file times follow the clock.
TEST(ClockOfAnOperation, TheLastOneIsFoundThoughItsFileIsDatedEarlier) {
  const TemporaryFolder folder;
  PosixEnv env;
  for (const char* label : {"first", "second"}) {
    ASSERT_TRUE(is_ok(RecordLog::create(env, folder.file("operation.resume"), {1, 1, label})));
  }
  namespace fs = std::filesystem;
  const auto first = fs::last_write_time(folder / "operation-1.resume");
  fs::last_write_time(folder / "operation.resume", first - 1h);
  EXPECT_EQ(newest_log(env, folder.file("operation.resume")).value(),
            folder.file("operation.resume"));
  // A crash came before the newest was renamed, so the last of those moved aside counts.
  ASSERT_TRUE(is_ok(RecordLog::create(env, folder.file("operation.resume"), {1, 1, "third"})));
  ASSERT_TRUE(is_ok(env.remove(folder.file("operation.resume"))));
  fs::last_write_time(folder / "operation-2.resume", first - 1h);
  EXPECT_EQ(newest_log(env, folder.file("operation.resume")).value(),
            folder.file("operation-2.resume"));
}

}  // namespace
}  // namespace orthonav::engine::operation_clock_test
