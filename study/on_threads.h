#pragma once

#include <functional>
#include <thread>
#include <vector>

namespace orthonav::engine {

/// Calls `work` on this many threads at once, including the calling one, and waits for all of them.
inline void on_threads(int count, const std::function<void()>& work) {
  std::vector<std::thread> threads;
  for (int i = 1; i < count; ++i) {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads) {
    thread.join();
  }
}

}  // namespace orthonav::engine
