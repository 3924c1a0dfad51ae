#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace orthonav::nav {

/// One thread that lives as long as the object and runs one task at a time, so that the frame loop
/// starts no threads and allocates nothing.
class Worker {
 public:
  Worker();
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Runs `task(argument)` on the thread; the last task must have been waited for. The task must
  /// not throw.
  void start(void (*task)(void*), void* argument);
  /// Returns when the task has ended; what it wrote is then visible here.
  void wait();

 private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  void (*task_)(void*) = nullptr;
  void* argument_ = nullptr;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace orthonav::nav
