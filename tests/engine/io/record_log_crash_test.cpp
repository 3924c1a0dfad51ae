#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "tests/support/told_log.h"

namespace orthonav::engine {
namespace {

using orthonav::test::after_kill;
using orthonav::test::after_power_loss;
using orthonav::test::durable_by;
using orthonav::test::Files;
using orthonav::test::is_ok;
using orthonav::test::kToldLog;
using orthonav::test::long_story;
using orthonav::test::MemoryEnv;
using orthonav::test::records_left;
using orthonav::test::tell;
using ::testing::HasSubstr;

/// If there is a log, another process continues it.
void expect_goes_on(const Files& files) {
  MemoryEnv env(files);
  auto again = RecordLog::reopen(env, kToldLog);
  ASSERT_TRUE(is_ok(again));
  const std::size_t before = again->records.size();
  ASSERT_TRUE(is_ok(again->log->append({3, 1, "after the crash"})));
  // And power is lost at once.
  for (const Files& left : after_power_loss(files, env.calls())) {
    MemoryEnv later(left);
    const auto read = read_log(later, kToldLog);
    ASSERT_TRUE(is_ok(read));
    ASSERT_EQ(read->records.size(), before + 1);
    EXPECT_EQ(read->records.back().payload, "after the crash");
  }
}

TEST(CrashOfALog, LeavesAPrefixWithAllThatWasSavedWheneverPowerIsLost) {
  const auto payloads = long_story();
  MemoryEnv env;
  const auto durable_after = tell(env, payloads);
  ASSERT_EQ(durable_after.size(), payloads.size());
  std::size_t tried = 0;
  std::size_t lost = 0;
  std::size_t too_many = 0;
  for (std::size_t n = 0; n <= env.calls().size(); ++n) {
    const auto calls = std::span(env.calls()).first(n);
    const std::size_t saved = durable_by(durable_after, n);
    for (const Files& files : after_power_loss({}, calls)) {
      const std::size_t left = records_left(files, payloads);
      lost += saved - std::min(saved, left);
      too_many += left - std::min(left, saved + 1);
      ASSERT_EQ(lost + too_many, 0u) << "after call " << n << ": " << left << " of " << saved;
      ++tried;
      if (left > 0 && (tried % 7) == 0) {
        expect_goes_on(files);
      }
    }
    const std::size_t left = records_left(after_kill({}, calls), payloads);
    ASSERT_GE(left, saved);
    too_many += left - std::min(left, saved + 1);
  }
  RecordProperty("prefixes", static_cast<int>(env.calls().size() + 1));
  RecordProperty("disks", static_cast<int>(tried));
  RecordProperty("lost_records", static_cast<int>(lost));
  RecordProperty("doubled_records", static_cast<int>(too_many));
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
      const bool aside = files.count("out/operation-1.resume") > 0;
      EXPECT_EQ(read_log(left, aside ? "out/operation-1.resume" : kToldLog)->records.size(), 2u)
          << "after call " << n;
      const bool begun = aside && files.count(kToldLog) > 0;
      EXPECT_GE(records_left(files, begun ? later : earlier), saved);
    }
  }
}

/// `demo` keeps no earlier log: whenever power is lost, one of the two exists and is complete.
TEST(CrashOfALog, ThatReplacesAnEarlierOneLeavesTheOneOrTheOther) {
  MemoryEnv first;
  const std::vector<std::string> earlier = {"earlier", std::string(700, 's'), "screw"};
  tell(first, earlier);
  const Files before = first.files();
  MemoryEnv env(before);
  const std::vector<std::string> later = {std::string(900, 'l'), "another"};
  const auto durable_after = tell(env, later, RecordLog::Earlier::kReplaced);
  ASSERT_EQ(durable_after.size(), later.size());
  std::size_t replaced = 0;
  std::size_t kept = 0;
  for (std::size_t n = 0; n <= env.calls().size(); ++n) {
    const auto calls = std::span(env.calls()).first(n);
    std::vector<Files> disks = after_power_loss(before, calls);
    disks.push_back(after_kill(before, calls));
    const std::size_t saved = durable_by(durable_after, n);
    for (const Files& files : disks) {
      MemoryEnv left(files);
      const auto read = read_log(left, kToldLog);
      ASSERT_TRUE(is_ok(read)) << "after call " << n;
      ASSERT_FALSE(read->records.empty()) << "after call " << n;
      const bool is_earlier = read->records.front().payload == earlier.front();
      ++(is_earlier ? kept : replaced);
      EXPECT_TRUE(saved == 0 || !is_earlier) << "after call " << n;
      EXPECT_GE(records_left(files, is_earlier ? earlier : later),
                is_earlier ? earlier.size() : saved);
    }
  }
  RecordProperty("prefixes", static_cast<int>(env.calls().size() + 1));
  RecordProperty("disks", static_cast<int>(kept + replaced));
  EXPECT_GT(kept, 10u);
  EXPECT_GT(replaced, 10u);
}

/// Whether the bytes after the last whole record are still there, or in the file beside the log.
bool keeps(const Files& files, const std::string& torn) {
  const auto ends = [&](const std::string& name) {
    const auto file = files.find(name);
    return file != files.end() && file->second.ends_with(torn);
  };
  return ends(kToldLog) || ends(kToldLog + ".dropped");
}

class FaultOfADisk : public ::testing::TestWithParam<int> {};

TEST_P(FaultOfADisk, AtAnyCallLeavesAPrefixAndIsToldOnce) {
  const auto payloads = long_story();
  MemoryEnv well;
  tell(well, payloads);
  RecordProperty("faults", static_cast<int>(2 * well.calls().size()));
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
  const auto payloads = long_story();
  tell(first, payloads);
  Files torn = first.files();
  torn[kToldLog] += "torn";
  MemoryEnv well(torn);
  ASSERT_TRUE(is_ok(RecordLog::reopen(well, kToldLog)));
  RecordProperty("faults", static_cast<int>(well.calls().size()));
  for (std::size_t n = 0; n < well.calls().size(); ++n) {
    MemoryEnv env(torn);
    env.fail_at(n, GetParam(), false);
    const auto again = RecordLog::reopen(env, kToldLog);
    ASSERT_FALSE(again.ok()) << "call " << n;
    EXPECT_THAT(again.error().message, HasSubstr("out"));
    for (const Files& files : after_power_loss(torn, env.calls())) {
      EXPECT_EQ(records_left(files, payloads), payloads.size());
      EXPECT_TRUE(keeps(files, "torn")) << "call " << n;
      MemoryEnv later(files);
      EXPECT_TRUE(is_ok(RecordLog::reopen(later, kToldLog)));
    }
  }
}

TEST_P(FaultOfADisk, AtAnyLookIsToldAndTheEarlierLogStays) {
  MemoryEnv first;
  const std::vector<std::string> earlier = {"earlier", "screw"};
  tell(first, earlier);
  const Files before = first.files();
  MemoryEnv well(before);
  ASSERT_TRUE(is_ok(RecordLog::create(well, kToldLog, {1, 1, "later"})));
  ASSERT_GE(well.looks(), 1u);
  for (std::size_t n = 0; n < well.looks(); ++n) {
    MemoryEnv env(before);
    env.fail_look_at(n, GetParam());
    const auto log = RecordLog::create(env, kToldLog, {1, 1, "later"});
    ASSERT_FALSE(log.ok()) << "look " << n;
    EXPECT_THAT(log.error().message, HasSubstr("out: cannot be read"));
    for (const Files& files : after_power_loss(before, env.calls())) {
      EXPECT_EQ(records_left(files, earlier), 2u);
    }
    EXPECT_TRUE(is_ok(RecordLog::create(env, kToldLog, {1, 1, "later"}))) << "well again";
  }
  RecordProperty("faults", static_cast<int>(well.looks()));
}

TEST_P(FaultOfADisk, AtAnyLookOfGoingOnChangesNothing) {
  MemoryEnv first;
  tell(first, {"begin", "one"});
  Files torn = first.files();
  torn[kToldLog] += "torn";
  const auto looks_once = [&](const auto& how) {
    MemoryEnv env(torn);
    env.fail_look_at(0, GetParam());
    const auto answer = how(env);
    EXPECT_FALSE(answer.ok());
    EXPECT_THAT(test::error_of(answer), HasSubstr("cannot be read"));
    EXPECT_TRUE(env.calls().empty());
    EXPECT_TRUE(is_ok(how(env))) << "well again";
  };
  looks_once([](MemoryEnv& env) { return RecordLog::reopen(env, kToldLog); });
  looks_once([](MemoryEnv& env) { return newest_log(env, kToldLog); });
  looks_once([](MemoryEnv& env) { return read_log(env, kToldLog); });
  RecordProperty("faults", 3);
}

INSTANTIATE_TEST_SUITE_P(Every, FaultOfADisk, ::testing::Values(ENOSPC, EIO, EROFS));

}  // namespace
}  // namespace orthonav::engine
