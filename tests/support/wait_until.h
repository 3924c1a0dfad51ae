#pragma once

#include <chrono>
#include <thread>

#include "base/stopwatch.h"

namespace orthonav::test {

/// How long a test waits before it fails: far longer than any wait takes, even on a loaded machine
/// under a sanitizer.
inline constexpr auto kLongestWait = std::chrono::seconds(30);

/// Asks `done` until it is true; false after `kLongestWait`. Devices never block (hal/api), so
/// results of another thread or process must be polled for. The pause leaves the core to that
/// thread; a test's outcome must not depend on its length.
template <class Done>
[[nodiscard]] bool wait_until(const Done& done) {
  constexpr auto kPause = std::chrono::microseconds(200);
  const Stopwatch waited;
  while (!done()) {
    if (waited.elapsed() > kLongestWait) {
      return false;
    }
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

}  // namespace orthonav::test
