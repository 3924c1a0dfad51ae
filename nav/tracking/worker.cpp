#include "nav/tracking/worker.h"

#include <utility>

#include "base/check.h"

namespace orthonav::nav {

Worker::Worker() : thread_([this] { loop(); }) {}

Worker::~Worker() {
  {
    const MutexLock lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Worker::start(void (*task)(void*), void* argument) {
  {
    const MutexLock lock(mutex_);
    ORTHONAV_CHECK(!task_);
    task_ = task;
    argument_ = argument;
  }
  changed_.notify_all();
}

void Worker::wait() {
  const MutexLock lock(mutex_);
  while (task_) {
    changed_.wait(mutex_);
  }
  if (const std::exception_ptr thrown = std::exchange(thrown_, nullptr)) {
    std::rethrow_exception(thrown);
  }
}

bool Worker::idle() {
  const MutexLock lock(mutex_);
  return !task_;
}

void Worker::loop() {
  for (;;) {
    void (*task)(void*) = nullptr;
    void* argument = nullptr;
    {
      const MutexLock lock(mutex_);
      while (!task_ && !ending_) {
        changed_.wait(mutex_);
      }
      if (!task_) {
        return;
      }
      task = task_;
      argument = argument_;
    }
    std::exception_ptr thrown;
    try {
      task(argument);
    } catch (...) {
      thrown = std::current_exception();
    }
    const MutexLock lock(mutex_);
    thrown_ = thrown;
    task_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace orthonav::nav
