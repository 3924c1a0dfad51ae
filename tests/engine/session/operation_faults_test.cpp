#include <gmock/gmock.h>

#include <cerrno>

#include "engine/session/text/wording.h"
#include "tests/support/is_ok.h"
#include "tests/support/resumed_operation.h"
#include "tests/support/scripted_surgeon.h"

namespace orthonav::engine::operation_faults_test {
namespace {

using test::error_of;
using test::Files;
using test::is_ok;
using test::kLogFolder;
using test::log_of;
using test::MemoryEnv;
using test::ResumedOperation;
using test::ScriptedSurgeon;
using test::touched_operation;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

/// What is left of an operation killed after `acts` acts.
Files killed_after(int acts) {
  MemoryEnv env;
  auto s = touched_operation(true);
  auto log = log_of(*s, env, true);
  ScriptedSurgeon surgeon(*s);
  for (int i = 0; i < acts; ++i) {
    surgeon.act();
  }
  return env.files();
}

class FaultOfLooking : public ::testing::TestWithParam<int> {};

TEST_P(FaultOfLooking, ForAnOperationIsOneLineAndChangesNothing) {
  const Files left = killed_after(10);
  MemoryEnv well(left);
  ASSERT_TRUE(is_ok(OperationLog::find(well, kLogFolder)));
  ASSERT_EQ(well.looks(), 3u) << "the lock, the folder, the log";
  for (std::size_t n = 0; n < well.looks(); ++n) {
    MemoryEnv env(left);
    env.fail_look_at(n, GetParam());
    const auto found = OperationLog::find(env, kLogFolder);
    ASSERT_FALSE(found.ok()) << "look " << n;
    EXPECT_THAT(error_of(found), HasSubstr("out"));
    EXPECT_THAT(error_of(found), Not(HasSubstr("\n")));
    EXPECT_TRUE(env.calls().empty());
    EXPECT_EQ(env.files(), left);
    EXPECT_TRUE(is_ok(OperationLog::find(env, kLogFolder))) << "its lock was let go";
  }
  RecordProperty("faults", static_cast<int>(well.looks()));
}

TEST_P(FaultOfLooking, BeforeAnOperationBeginsLeavesTheEarlierOne) {
  const Files left = killed_after(10);
  for (std::size_t n = 0; n < 2; ++n) {
    MemoryEnv env(left);
    env.fail_look_at(n, GetParam());
    const auto begin = [&] {
      auto s = touched_operation(true);
      return OperationLog::begin(env, kLogFolder, test::identity_of(*s, true),
                                 s->session().levels(), RecordWriter::Waits::kUntilDurable,
                                 RecordLog::Earlier::kKept);
    };
    const auto log = begin();
    ASSERT_FALSE(log.ok()) << "look " << n;
    EXPECT_EQ(env.files().at(test::kLogPath), left.at(test::kLogPath));
    EXPECT_TRUE(is_ok(begin())) << "its lock was let go";
  }
  RecordProperty("faults", 2);
}

/// The operation was found, but then its log can't be read again.
TEST_P(FaultOfLooking, AtItsOwnLogGoesOnUnsaved) {
  MemoryEnv env(killed_after(10));
  env.fail_look_at(3, GetParam());
  ResumedOperation r(env, true);
  ASSERT_TRUE(is_ok(r.resumed));
  EXPECT_EQ(env.looks(), 4u);
  EXPECT_THAT(error_of(r.log->written()), HasSubstr("out/operation.resume: cannot be read"));
  EXPECT_THAT(detail_text(r.operation->pair().status), EndsWith("NOT SAVED"));
  ScriptedSurgeon(*r.operation).finish();
  EXPECT_EQ(r.operation->session().current_step(), Step::kDone);
  EXPECT_TRUE(env.calls().empty()) << "nothing is written to what can't be read";
  RecordProperty("faults", 1);
}

INSTANTIATE_TEST_SUITE_P(Every, FaultOfLooking, ::testing::Values(EIO, EACCES, ENOENT));

}  // namespace
}  // namespace orthonav::engine::operation_faults_test
