#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/io/posix_env.h"
#include "engine/session/log/logged_operation.h"
#include "tests/support/wait_until.h"
#include "tests/tools/faults/failing_disk.h"
#include "tests/tools/faults/short_run.h"

namespace orthonav::test::memory_faults_test {
namespace {

using nlohmann::json;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr rlim_t kMiB = rlim_t{1} << 20U;

void limit_memory_to(rlim_t bytes) {
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_DATA, &limit);
}

/// A process's memory as RLIMIT_DATA counts it.
rlim_t data_bytes_of(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  std::string word;
  while (status >> word && word != "VmData:") {
  }
  rlim_t kilobytes = 0;
  status >> kilobytes;
  return kilobytes << 10U;
}

TEST(MemoryFaults, WithLessMemoryThanARunNeedsItEndsWithALineThatSaysSo) {
  if (!disk_can_fail()) {
    GTEST_SKIP() << "a sanitizer takes more memory than it leaves";
  }
  ShortRun run;
  // The bounds are halved until they are near, so that memory ends early, late, and not at all.
  rlim_t too_little = 32 * kMiB;
  rlim_t enough = 512 * kMiB;
  while (enough - too_little > 16 * kMiB) {
    const rlim_t limit = (too_little + enough) / 2;
    const Called called = run.run([limit] { limit_memory_to(limit); });
    SCOPED_TRACE(std::to_string(limit / kMiB) + " MiB: " + called.err);
    if (called.code == 0) {
      EXPECT_TRUE(all_is_kept(run));
      enough = limit;
    } else {
      EXPECT_THAT(called.code, AnyOf(1, 2));
      EXPECT_THAT(called.err, HasSubstr("orthonav: out of memory"));
      expect_readable(run);
      too_little = limit;
    }
  }
  EXPECT_LT(enough, 512 * kMiB);
  EXPECT_GT(too_little, 32 * kMiB);
}

TEST(MemoryFaults, InTheMiddleOfARunTheyEndItInOrderWithEveryFileWhole) {
  if (!disk_can_fail()) {
    GTEST_SKIP() << "a sanitizer takes more memory than it leaves";
  }
  const ScratchFolder folder;
  write_one_level_case(folder.file("case"));
  const std::string out = folder.file("out");
  const std::string recording = folder.file("recording");
  StartedCommand command({"run", "--case", folder.file("case"), "--headset", "sim:?seed=1", "--out",
                          out, "--record", recording});
  ASSERT_TRUE(wait_until([&] {
    std::error_code none;
    return std::filesystem::file_size(recording + ".part/frames.csv", none) > 100 && !none;
  }));
  const rlimit now{data_bytes_of(command.process()), RLIM_INFINITY};
  ASSERT_EQ(prlimit(command.process(), RLIMIT_DATA, &now, nullptr), 0);
  const Called ended = command.wait();
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("orthonav: out of memory: ending in order\n"));
  const json report = json::parse(content_of(out + "/report.json"));
  EXPECT_THAT(report["why_not"].get<std::string>(), HasSubstr("stopped by SIGTERM"));
  engine::PosixEnv env;
  const auto log = engine::LoggedOperation::read(env, out + "/operation.resume");
  ASSERT_TRUE(log.ok()) << log.error().message;
  EXPECT_TRUE(log->ended && !log->done);
  const Called resumed = orthonav({"run", "--case", folder.file("case"), "--headset", "sim:?seed=1",
                                   "--out", out, "--resume", "--frames", "2"});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  const Called replayed = orthonav({"recording", "repair", recording, "--json"});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_EQ(json::parse(replayed.out)["pairs"], report["frames"]["displayed"]);
}

}  // namespace
}  // namespace orthonav::test::memory_faults_test
