#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include "tests/support/wait_until.h"
#include "tools/orthonav/shared/memory_reserve.h"
#include "tools/orthonav/shared/stop_signals.h"

namespace orthonav::tools::memory_test {
namespace {

/// This process's memory as RLIMIT_DATA counts it.
rlim_t data_bytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "VmData:") {
  }
  rlim_t kilobytes = 0;
  status >> kilobytes;
  return kilobytes << 10U;
}

/// Ends with 0 if the command is asked to end and has memory left to do so.
[[noreturn]] void use_up(bool reserve) {
  StopSignals signals;
  if (reserve) {
    keep_memory_reserve();
  }
  std::atomic<bool> asked = false;
  signals.on_stop([&] { asked = true; });
  const rlim_t most = data_bytes() + (rlim_t{64} << 20U);
  const rlimit limit{most, most};
  setrlimit(RLIMIT_DATA, &limit);
  std::vector<std::vector<char>> all;
  all.reserve(10'000);
  try {
    while (!asked) {
      all.emplace_back(std::size_t{256} << 10U);
    }
    const std::vector<char> to_end_with(std::size_t{1} << 20U);
    std::_Exit(0);
  } catch (const std::bad_alloc&) {
    // The signal may not have arrived yet; the memory freed here is enough to wait for it.
    all.clear();
    std::_Exit(reserve && test::wait_until([&] { return asked.load(); }) ? 0 : 3);
  }
}

TEST(MemoryReserveDeathTest, EndsInOrderWithOneLineOnceMemoryIsUsedUp) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(use_up(true), ::testing::ExitedWithCode(0),
              "^orthonav: out of memory: ending in order\n");
  EXPECT_EXIT(use_up(false), ::testing::ExitedWithCode(3), "") << "the control";
}

}  // namespace
}  // namespace orthonav::tools::memory_test
