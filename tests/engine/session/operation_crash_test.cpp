#include <gmock/gmock.h>

#include <algorithm>

#include "engine/session/log/operation_log.h"
#include "tests/support/is_ok.h"
#include "tests/support/logged_operation.h"
#include "tests/support/memory_env.h"
#include "tests/support/scripted_surgeon.h"

namespace orthonav::engine::operation_crash_test {
namespace {

using test::after_kill;
using test::after_power_loss;
using test::Files;
using test::is_ok;
using test::kLogFolder;
using test::kLogPath;
using test::log_of;
using test::MemoryEnv;
using test::ScriptedOperation;
using test::ScriptedSurgeon;

/// How many records the surgeon had been told are saved, after a number of calls.
struct Told {
  std::size_t calls = 0;
  std::size_t records = 0;
};

/// Runs a whole operation of two levels, and returns what was saved when.
std::vector<Told> operate(MemoryEnv& env) {
  ScriptedOperation s({"L4", "L5"}, {}, Verification::kByTouch);
  s.registers_within(0.0003);
  auto log = log_of(s, env);
  std::vector<Told> told = {{env.calls().size(), 1}};
  ScriptedSurgeon surgeon(s);
  while (surgeon.act()) {
    told.push_back({env.calls().size(), read_log(env, kLogPath)->records.size()});
  }
  EXPECT_EQ(s.session().current_step(), Step::kDone);
  EXPECT_TRUE(is_ok(log->finish(true, "")));
  return told;
}

std::size_t saved_by(const std::vector<Told>& told, std::size_t calls) {
  std::size_t records = 0;
  for (const Told& each : told) {
    records = each.calls <= calls ? each.records : records;
  }
  return records;
}

/// How many samples the saved regions in these first records hold.
std::size_t samples_in(std::span<const Record> records) {
  const auto operation = LoggedOperation::from({records.begin(), records.end()}, "log");
  std::size_t samples = 0;
  for (const std::vector<nav::Region>& strokes : operation->strokes) {
    for (const nav::Region& region : strokes) {
      samples += region.samples.size();
    }
  }
  return samples;
}

/// Whatever a crash leaves, another program finds the operation in some earlier state, with
/// everything that the surgeon had been told was saved.
TEST(CrashOfAnOperation, LeavesWhatHadHappenedUpToSomeMoment) {
  MemoryEnv env;
  const std::vector<Told> told = operate(env);
  const std::vector<Record> all = read_log(env, kLogPath)->records;
  std::vector<std::size_t> samples = {0};  // by the number of records
  for (std::size_t n = 1; n <= all.size(); ++n) {
    ASSERT_TRUE(is_ok(LoggedOperation::from({all.begin(), all.begin() + n}, "log"))) << n;
    samples.push_back(samples_in(std::span(all).first(n)));
  }
  EXPECT_GT(samples.back(), 15u);
  int tried = 0;
  std::size_t lost_samples = 0;
  for (std::size_t n = told.front().calls; n <= env.calls().size(); ++n) {
    const auto calls = std::span(env.calls()).first(n);
    std::vector<Files> disks = after_power_loss({}, calls);
    disks.push_back(after_kill({}, calls));
    for (const Files& files : disks) {
      MemoryEnv left(files);
      const auto read = read_log(left, kLogPath);
      ASSERT_TRUE(is_ok(read));
      ASSERT_LE(read->records.size(), all.size());
      const std::size_t saved = saved_by(told, n);
      EXPECT_GE(read->records.size(), saved) << "after call " << n;
      lost_samples += samples[saved] - std::min(samples[saved], samples[read->records.size()]);
      EXPECT_TRUE(std::equal(read->records.begin(), read->records.end(), all.begin()));
      ++tried;
    }
  }
  EXPECT_EQ(lost_samples, 0u);
  RecordProperty("prefixes", static_cast<int>(env.calls().size() + 1 - told.front().calls));
  RecordProperty("disks", tried);
  RecordProperty("lost_samples", static_cast<int>(lost_samples));
  EXPECT_GT(tried, 200);
}

TEST(CrashOfAnOperation, TimesSayNothingOfTheOrder) {
  // The clock of the device is set back between two programs, but record numbers continue.
  MemoryEnv env;
  {
    ScriptedOperation s({"L4"}, {}, Verification::kByTouch);
    auto log = log_of(s, env);
    s.pairs(1000);
    s.registers_first_level();
  }
  auto found = OperationLog::find(env, kLogFolder);
  ASSERT_TRUE(is_ok(found));
  ScriptedOperation again({"L4"}, {}, Verification::kByTouch);
  auto log = OperationLog::reopen(env, std::move(*found), RecordWriter::Waits::kUntilDurable);
  again.session().observe(log.get());
  again.registers_first_level();
  const std::vector<Record> records = read_log(env, kLogPath)->records;
  std::uint64_t number = 0;
  for (const Record& record : records) {
    EXPECT_EQ(record.number, ++number);
  }
  const auto recorded = LoggedOperation::from(records, kLogPath);
  ASSERT_TRUE(is_ok(recorded));
  EXPECT_EQ(recorded->strokes[0].size(), 1u) << "World was another one: stroked again";
  EXPECT_EQ(recorded->resumed, 1);
}

}  // namespace
}  // namespace orthonav::engine::operation_crash_test
