#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "engine/io/posix_env.h"
#include "engine/session/session.h"
#include "tests/support/is_ok.h"
#include "tests/support/killed_process.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/screws_done.h"
#include "tests/support/scripted_surgeon.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::session_kill_test {
namespace {

using test::after_kill;
using test::after_power_loss;
using test::EnvCall;
using test::Files;
using test::is_ok;
using test::kEveryScrewOnce;
using test::kLogFolder;
using test::kLogPath;
using test::log_of;
using test::MemoryEnv;
using test::ResumedOperation;
using test::screws_done;
using test::ScriptedSurgeon;
using test::Story;
using test::TemporaryFolder;
using test::touched_operation;

int doubled_in(const std::map<std::string, int>& done) {
  int doubled = 0;
  for (const auto& [screw, times] : done) {
    doubled += times - 1;
  }
  return doubled;
}

/// The end of an operation that was continued.
struct Ended {
  std::vector<Vec3> entries_m;  ///< where each screw went
  int doubled = 0;              ///< screws that were declared done more than once
};

/// Another program continues from what was left, to the end.
Ended finished(Env& env, bool reference, const std::string& folder, Story story = Story::kPlain) {
  ResumedOperation r(env, reference, folder);
  EXPECT_TRUE(is_ok(r.resumed));
  ScriptedSurgeon(*r.operation, 5, story).finish();
  EXPECT_EQ(r.operation->session().current_step(), Step::kDone);
  EXPECT_TRUE(is_ok(r.log->finish(true, "")));
  Ended ended;
  for (std::size_t i = 0; i < r.before.state.levels.size(); ++i) {
    const LevelState& level = r.operation->session().levels()[i];
    EXPECT_TRUE(level.finished());
    for (std::size_t screw = 0; screw < level.screws.size(); ++screw) {
      const auto& executed = level.screws[screw].executed;
      EXPECT_TRUE(executed);
      ended.entries_m.push_back(executed ? executed->axis.point.v : Vec3{});
      const ScrewState& before = r.before.state.levels[i].screws[screw];
      if (before.done) {
        EXPECT_EQ(executed->axis.point, before.executed->axis.point) << "to the bit";
      }
    }
  }
  const auto log = read_log(env, folder + "/operation.resume");
  const auto done = screws_done(log->records);
  EXPECT_EQ(done, kEveryScrewOnce);
  ended.doubled = doubled_in(done);
  return ended;
}

/// Expects a refusal, a changed plan, a redone screw and an override, so that kills fall between
/// them.
void expect_events(const Session& session) {
  EXPECT_TRUE(session.levels()[0].screws[1].replanned());
  EXPECT_EQ(session.levels()[1].screws[0].redone, 1);
  EXPECT_TRUE(session.levels()[1].screws[1].wire.measured->kept);
  EXPECT_EQ(session.levels()[1].attempts, 2) << "the first was refused";
}

/// An uninterrupted operation; returns where each screw went.
std::vector<Vec3> operate(MemoryEnv& env, bool reference, Story story = Story::kPlain) {
  std::vector<Vec3> entries_m;
  auto s = touched_operation(reference);
  auto log = log_of(*s, env, reference);
  ScriptedSurgeon(*s, 5, story).finish();
  EXPECT_EQ(s->session().current_step(), Step::kDone);
  if (story == Story::kEventful) {
    expect_events(s->session());
  }
  for (const LevelState& level : s->session().levels()) {
    for (const ScrewState& screw : level.screws) {
      entries_m.push_back(screw.executed->axis.point.v);
    }
  }
  return entries_m;
}

class KilledOperation : public ::testing::TestWithParam<std::tuple<bool, Story>> {};

/// Until the first level is registered the records are the same in each story.
std::size_t records_before_events(MemoryEnv& env) {
  const std::vector<Record> records = read_log(env, kLogPath)->records;
  const auto first = std::ranges::find(
      records, static_cast<std::uint16_t>(OperationRecord::kRegistration), &Record::type);
  return static_cast<std::size_t>(first - records.begin());
}

TEST_P(KilledOperation, AtEveryEventEndsWithTheSameScrewsAndNoneTwice) {
  const auto& [reference, story] = GetParam();
  const bool eventful = story == Story::kEventful;
  MemoryEnv env;
  const std::vector<Vec3> expected_m = operate(env, reference, story);
  // The operation is the same whenever power fails with the same number of whole records.
  std::set<std::size_t> tried;
  const std::size_t before_events = records_before_events(env);
  int disks = 0;
  int doubled = 0;
  for (std::size_t n = 5; n <= env.calls().size(); ++n) {
    const auto calls = std::span(env.calls()).first(n);
    std::vector<Files> left = after_power_loss({}, calls);
    left.push_back(after_kill({}, calls));
    for (const Files& files : left) {
      MemoryEnv disk(files);
      const auto read = read_log(disk, kLogPath);
      ASSERT_TRUE(is_ok(read));
      ++disks;
      if (eventful && read->records.size() < before_events) {
        continue;
      }
      if (!tried.insert(read->records.size()).second) {
        continue;
      }
      const Ended ended = finished(disk, reference, kLogFolder, story);
      doubled += ended.doubled;
      ASSERT_EQ(ended.entries_m.size(), expected_m.size());
      for (std::size_t i = 0; i < expected_m.size(); ++i) {
        EXPECT_LT((ended.entries_m[i] - expected_m[i]).norm(), 2e-5) << "killed after call " << n;
      }
    }
  }
  RecordProperty("kills", static_cast<int>(tried.size()));
  RecordProperty("disks", disks);
  RecordProperty("doubled_screws", doubled);
  EXPECT_GT(tried.size(), 25u);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutReference, KilledOperation,
                         ::testing::Values(std::tuple(false, Story::kPlain),
                                           std::tuple(true, Story::kPlain),
                                           std::tuple(true, Story::kEventful)));

/// What a power failure leaves after a second program continued the files of a killed one: at once,
/// and in the middle of its last record. For each, how many records were reported as saved.
struct WithoutPower {
  std::vector<Files> disks;
  std::size_t saved = 0;
};

std::vector<WithoutPower> without_power(std::vector<EnvCall> calls, bool reference) {
  MemoryEnv second(after_kill({}, calls));
  ResumedOperation r(second, reference, kLogFolder);
  EXPECT_TRUE(is_ok(r.resumed));
  const std::size_t opened = second.calls().size();
  const std::size_t found = read_log(second, kLogPath)->records.size();
  ScriptedSurgeon surgeon(*r.operation);
  for (int i = 0; i < 8 && surgeon.act(); ++i) {
  }
  const std::size_t told = read_log(second, kLogPath)->records.size();
  const std::size_t killed = calls.size();
  calls.insert(calls.end(), second.calls().begin(), second.calls().end());
  const auto after = [&](std::size_t n) { return after_power_loss({}, std::span(calls).first(n)); };
  return {{after(killed + opened), found}, {after(calls.size() - 1), told - 1}};
}

class KilledAndWithoutPower : public ::testing::TestWithParam<bool> {};

TEST_P(KilledAndWithoutPower, EndsWithEachScrewOnce) {
  MemoryEnv first;
  operate(first, GetParam());
  int kills = 0;
  int disks = 0;
  int doubled = 0;
  std::size_t lost = 0;
  constexpr std::size_t kEvery = 17;  // odd: between a write and its sync, and after both
  for (std::size_t n = 5; n <= first.calls().size(); n += kEvery) {
    const auto calls = std::span(first.calls()).first(n);
    for (const auto& [left, saved] : without_power({calls.begin(), calls.end()}, GetParam())) {
      std::set<std::size_t> tried;
      for (const Files& files : left) {
        MemoryEnv disk(files);
        const std::size_t records = read_log(disk, kLogPath)->records.size();
        lost += saved - std::min(saved, records);
        ++disks;
        if (tried.insert(records).second) {
          doubled += finished(disk, GetParam(), kLogFolder).doubled;
        }
      }
    }
    ++kills;
  }
  EXPECT_EQ(lost, 0u);
  RecordProperty("kills", kills);
  RecordProperty("disks", disks);
  RecordProperty("lost_records", static_cast<int>(lost));
  RecordProperty("doubled_screws", doubled);
  EXPECT_GE(kills, 4);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutReference, KilledAndWithoutPower, ::testing::Bool());

/// A child process that performs one act after another, reporting each; killed after `acts` of
/// them.
bool operate_until_killed(const std::string& folder, int acts) {
  return test::kill_after(acts, [&](const std::function<void()>& tell) {
    PosixEnv env;
    auto s = touched_operation(true);
    auto log = OperationLog::begin(env, folder, test::identity_of(*s, true), s->session().levels(),
                                   RecordWriter::Waits::kNot, RecordLog::Earlier::kKept);
    s->session().observe(log->get());
    ScriptedSurgeon surgeon(*s);
    for (;;) {
      surgeon.act();
      tell();
    }
  });
}

TEST(KilledProcess, IsGoneOnWithByAnother) {
  constexpr std::array kAfterActs = {1, 5, 10, 14, 19, 26, 40};
  int doubled = 0;
  for (const int acts : kAfterActs) {
    const TemporaryFolder folder;
    ASSERT_TRUE(operate_until_killed(folder.path().string(), acts));
    PosixEnv env;
    ASSERT_TRUE(is_ok(OperationLog::find(env, folder.path().string()))) << "the lock went with it";
    doubled += finished(env, true, folder.path().string()).doubled;
  }
  RecordProperty("processes_killed", static_cast<int>(kAfterActs.size()));
  RecordProperty("doubled_screws", doubled);
}

}  // namespace
}  // namespace orthonav::engine::session_kill_test
