#pragma once

#include <exception>
#include <thread>

#include "base/mutex.h"

namespace orthonav::nav {

/// One thread that lives as long as the object and runs one task at a time, so that the frame loop
/// starts no threads and allocates nothing.
class Worker {
 public:
  Worker();
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Runs `task(argument)` on the thread; call `wait` for the previous task first.
  void start(void (*task)(void*), void* argument);
  /// Returns when the task has ended; its writes are then visible to the caller. An exception that
  /// it threw is rethrown here.
  void wait();
  /// Whether the task has ended: `wait` would return at once.
  [[nodiscard]] bool idle();

 private:
  void loop();

  Mutex mutex_;
  ConditionVariable changed_;
  void (*task_)(void*) ORTHONAV_GUARDED_BY(mutex_) = nullptr;
  void* argument_ ORTHONAV_GUARDED_BY(mutex_) = nullptr;
  std::exception_ptr thrown_ ORTHONAV_GUARDED_BY(mutex_);
  bool ending_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace orthonav::nav
