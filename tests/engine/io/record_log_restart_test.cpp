// A process dies, another continues its log, and then power is lost while data that the first had
// written but not made durable are still on their way to the disk.
#include <gtest/gtest.h>

#include "tests/support/told_log.h"

namespace orthonav::engine {
namespace {

using orthonav::test::after_kill;
using orthonav::test::after_power_loss;
using orthonav::test::durable_by;
using orthonav::test::EnvCall;
using orthonav::test::Files;
using orthonav::test::is_ok;
using orthonav::test::kToldLog;
using orthonav::test::long_story;
using orthonav::test::MemoryEnv;
using orthonav::test::tell;

/// Over all disks that were tried.
struct Tried {
  int kills = 0;
  int disks = 0;
  int torn = 0;
  std::size_t lost = 0;
};

/// After the log reported its size, all of that survives, and the torn end is kept in a file beside
/// it.
void expect_left(const Files& files, const std::string& path, std::size_t records,
                 const std::string& torn, Tried& tried) {
  MemoryEnv disk(files);
  const auto read = read_log(disk, path);
  const std::size_t left = read ? read->records.size() : 0;
  tried.lost += records - std::min(records, left);
  EXPECT_GE(left, records);
  if (!torn.empty()) {
    const auto dropped = files.find(path + ".dropped");
    EXPECT_TRUE(dropped != files.end() && dropped->second == torn);
  }
  ++tried.disks;
}

/// Another process goes on after these calls of the first; power is lost after each of its own.
void expect_goes_on(std::vector<EnvCall> calls, std::size_t saved, Tried& tried) {
  const Files killed = after_kill({}, calls);
  MemoryEnv env(killed);
  const auto path = newest_log(env, kToldLog);
  ASSERT_TRUE(is_ok(path));
  if (!*path) {
    EXPECT_EQ(saved, 0u);
    return;
  }
  auto again = RecordLog::reopen(env, **path);
  ASSERT_TRUE(is_ok(again));
  const std::size_t found = again->records.size();
  ASSERT_GE(found, saved);
  const std::string& content = killed.at(**path);
  const std::string torn = content.substr(content.size() - again->dropped_bytes);
  tried.torn += torn.empty() ? 0 : 1;
  const std::size_t opened = calls.size() + env.calls().size();
  ASSERT_TRUE(is_ok(again->log->append({3, 1, "after the crash"})));
  calls.insert(calls.end(), env.calls().begin(), env.calls().end());
  for (std::size_t n = opened; n <= calls.size(); ++n) {
    for (const Files& files : after_power_loss({}, std::span(calls).first(n))) {
      expect_left(files, **path, found + (n == calls.size() ? 1 : 0), torn, tried);
    }
  }
  ++tried.kills;
}

TEST(RestartOfALog, LosesNothingThatWasReadWhenPowerIsLostAfterAKill) {
  MemoryEnv env;
  const auto durable_after = tell(env, long_story());
  Tried tried;
  for (std::size_t n = 0; n <= env.calls().size(); ++n) {
    std::vector<EnvCall> calls(env.calls().begin(),
                               env.calls().begin() + static_cast<std::ptrdiff_t>(n));
    const std::size_t saved = durable_by(durable_after, n);
    expect_goes_on(calls, saved, tried);
    if (n > 0 && calls.back().what == EnvCall::What::kAppend) {
      calls.back().bytes.resize(calls.back().bytes.size() * 2 / 3);
      expect_goes_on(calls, saved, tried);
    }
    ASSERT_FALSE(HasFailure()) << "killed after call " << n;
  }
  RecordProperty("kills", tried.kills);
  RecordProperty("disks", tried.disks);
  RecordProperty("lost_records", static_cast<int>(tried.lost));
  EXPECT_GT(tried.torn, 30);
  EXPECT_GT(tried.disks, 500);
}

/// The torn end exists at every moment of resuming: at the end of the log, or in the file beside
/// it.
TEST(RestartOfALog, KeepsATornEndWheneverPowerIsLost) {
  MemoryEnv first;
  const std::vector<std::string> payloads = {"begin", std::string(700, 'a')};
  tell(first, payloads);
  Files before = first.files();
  const std::string whole = before.at(kToldLog);
  const std::string torn(900, 't');
  before[kToldLog] += torn;
  MemoryEnv env(before);
  auto again = RecordLog::reopen(env, kToldLog);
  ASSERT_TRUE(is_ok(again));
  const std::size_t opened = env.calls().size();
  ASSERT_TRUE(is_ok(again->log->append({3, 1, "after the crash"})));
  for (std::size_t n = 0; n <= env.calls().size(); ++n) {
    for (const Files& files : after_power_loss(before, std::span(env.calls()).first(n))) {
      const auto dropped = files.find(kToldLog + ".dropped");
      const bool beside = dropped != files.end() && dropped->second == torn;
      EXPECT_TRUE(beside || (n < opened && files.at(kToldLog) == whole + torn))
          << "after call " << n;
    }
  }
}

}  // namespace
}  // namespace orthonav::engine
