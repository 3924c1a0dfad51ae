#include "nav/tracking/worker.h"

#include "base/check.h"

namespace orthonav::nav {

Worker::Worker() : thread_([this] { loop(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Worker::start(void (*task)(void*), void* argument) {
  {
    const std::lock_guard lock(mutex_);
    ORTHONAV_CHECK(!task_);
    task_ = task;
    argument_ = argument;
  }
  changed_.notify_all();
}

void Worker::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !task_; });
}

void Worker::loop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return task_ || ending_; });
    if (!task_) {
      return;
    }
    lock.unlock();
    task_(argument_);
    lock.lock();
    task_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace orthonav::nav
