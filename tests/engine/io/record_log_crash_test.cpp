#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>

#include "engine/io/record_log.h"
#include "tests/support/is_ok.h"
#include "tests/support/memory_env.h"

namespace orthonav::engine {
namespace {

using orthonav::test::after_kill;
using orthonav::test::after_power_loss;
using orthonav::test::Files;
using orthonav::test::is_ok;
using orthonav::test::MemoryEnv;
using ::testing::HasSubstr;

const std::string kLog = "out/operation.log";

/// What is recorded, with lengths on both sides of a block's.
std::vector<std::string> story() {
  std::vector<std::string> payloads = {"begin", "", "a"};
  for (std::size_t i = 0; i < 36; ++i) {
    const std::size_t size = i % 3 == 0 ? 480 + i : (i * i * 37) % 3000;
    payloads.push_back(std::string(size, static_cast<char>('b' + i % 20)));
  }
  return payloads;
}

/// Tells it; returns after how many calls each record was said to be durable.
std::vector<std::size_t> tell(MemoryEnv& env, const std::vector<std::string>& payloads) {
  std::vector<std::size_t> durable_after;
  auto log = RecordLog::create(env, kLog, {1, 1, payloads.front()});
  for (std::size_t i = 0; log && i < payloads.size(); ++i) {
    if (i > 0 && !(*log)->append({2, 1, payloads[i]})) {
      break;
    }
    durable_after.push_back(env.calls().size());
  }
  return durable_after;
}

/// How many records the newest log holds; each must be as it was told.
std::size_t records_left(const Files& files, const std::vector<std::string>& payloads) {
  MemoryEnv env(files);
  const auto path = newest_log(env, kLog);
  if (!path || !*path) {
    return 0;
  }
  const auto read = read_log(env, **path);
  EXPECT_TRUE(is_ok(read));
  if (!read) {
    return 0;
  }
  EXPECT_GE(read->records.size(), 1u) << "a log has its name before it has its first record";
  EXPECT_LE(read->records.size(), payloads.size());
  for (std::size_t i = 0; i < std::min(read->records.size(), payloads.size()); ++i) {
    EXPECT_EQ(read->records[i].payload, payloads[i]);
  }
  return read->records.size();
}

/// Of a log that is there, another process goes on with.
void expect_goes_on(const Files& files) {
  MemoryEnv env(files);
  auto again = RecordLog::reopen(env, kLog);
  ASSERT_TRUE(is_ok(again));
  const std::size_t before = again->records.size();
  ASSERT_TRUE(is_ok(again->log->append({3, 1, "after the crash"})));
  // And power is lost at once.
  for (const Files& left : after_power_loss(files, env.calls())) {
    MemoryEnv later(left);
    const auto read = read_log(later, kLog);
    ASSERT_TRUE(is_ok(read));
    ASSERT_EQ(read->records.size(), before + 1);
    EXPECT_EQ(read->records.back().payload, "after the crash");
  }
}

std::size_t durable_by(const std::vector<std::size_t>& durable_after, std::size_t calls) {
  return static_cast<std::size_t>(std::count_if(durable_after.begin(), durable_after.end(),
                                                [&](std::size_t after) { return after <= calls; }));
}

TEST(CrashOfALog, LeavesAPrefixWithAllThatWasSavedWheneverPowerIsLost) {
  const auto payloads = story();
  MemoryEnv env;
  const auto durable_after = tell(env, payloads);
  ASSERT_EQ(durable_after.size(), payloads.size());
  std::size_t tried = 0;
  for (std::size_t n = 0; n <= env.calls().size(); ++n) {
    const auto calls = std::span(env.calls()).first(n);
    const std::size_t saved = durable_by(durable_after, n);
    for (const Files& files : after_power_loss({}, calls)) {
      const std::size_t left = records_left(files, payloads);
      ASSERT_GE(left, saved) << "after call " << n;
      ASSERT_LE(left, saved + 1) << "after call " << n;
      ++tried;
      if (left > 0 && (tried % 7) == 0) {
        expect_goes_on(files);
      }
    }
    const std::size_t left = records_left(after_kill({}, calls), payloads);
    ASSERT_GE(left, saved);
  }
  RecordProperty("prefixes", static_cast<int>(env.calls().size() + 1));
  RecordProperty("disks", static_cast<int>(tried));
  EXPECT_GT(tried, 500u);
}

TEST(CrashOfALog, NeverLosesTheOperationBefore) {
  MemoryEnv first;
  const std::vector<std::string> earlier = {"earlier", "screw"};
  tell(first, earlier);
  const Files before = first.files();
  MemoryEnv env(before);
  const std::vector<std::string> later = {"later", "another"};
  const auto durable_after = tell(env, later);
  for (std::size_t n = 0; n <= env.calls().size(); ++n) {
    const std::size_t saved = durable_by(durable_after, n);
    for (const Files& files : after_power_loss(before, std::span(env.calls()).first(n))) {
      MemoryEnv left(files);
      const bool aside = files.count("out/operation-1.log") > 0;
      EXPECT_EQ(read_log(left, aside ? "out/operation-1.log" : kLog)->records.size(), 2u)
          << "after call " << n;
      const bool begun = aside && files.count(kLog) > 0;
      EXPECT_GE(records_left(files, begun ? later : earlier), saved);
    }
  }
}

class FaultOfADisk : public ::testing::TestWithParam<int> {};

TEST_P(FaultOfADisk, AtAnyCallLeavesAPrefixAndIsToldOnce) {
  const auto payloads = story();
  MemoryEnv well;
  tell(well, payloads);
  for (const bool from_then_on : {false, true}) {
    for (std::size_t n = 0; n < well.calls().size(); ++n) {
      MemoryEnv env;
      env.fail_at(n, GetParam(), from_then_on);
      const auto durable_after = tell(env, payloads);
      EXPECT_LT(durable_after.size(), payloads.size()) << "call " << n << " failed unnoticed";
      for (const Files& files : after_power_loss({}, env.calls())) {
        ASSERT_GE(records_left(files, payloads), durable_after.size());
      }
      EXPECT_GE(records_left(env.files(), payloads), durable_after.size());
    }
  }
}

TEST_P(FaultOfADisk, AtAnyCallOfGoingOnLeavesWhatWasSaved) {
  MemoryEnv first;
  const auto payloads = story();
  tell(first, payloads);
  Files torn = first.files();
  torn[kLog] += "torn";
  MemoryEnv well(torn);
  ASSERT_TRUE(is_ok(RecordLog::reopen(well, kLog)));
  for (std::size_t n = 0; n < well.calls().size(); ++n) {
    MemoryEnv env(torn);
    env.fail_at(n, GetParam(), false);
    const auto again = RecordLog::reopen(env, kLog);
    ASSERT_FALSE(again.ok()) << "call " << n;
    EXPECT_THAT(again.error().message, HasSubstr("out"));
    for (const Files& files : after_power_loss(torn, env.calls())) {
      EXPECT_EQ(records_left(files, payloads), payloads.size());
      MemoryEnv later(files);
      EXPECT_TRUE(is_ok(RecordLog::reopen(later, kLog)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, FaultOfADisk, ::testing::Values(ENOSPC, EIO, EROFS));

}  // namespace
}  // namespace orthonav::engine
