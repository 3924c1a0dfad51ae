#include "base/mutex.h"

namespace orthonav {

class Count {
 public:
  void add() {
    {
      const MutexLock lock(mutex_);
      add_locked();
    }
    changed_.notify_all();
  }
  int wait_for_some(std::chrono::steady_clock::time_point deadline) {
    const MutexLock lock(mutex_);
    while (count_ == 0 && changed_.wait_until(mutex_, deadline)) {
    }
    return count_;
  }
  void wait_for_none() {
    const MutexLock lock(mutex_);
    while (count_ > 0) {
      changed_.wait(mutex_);
    }
  }

 private:
  void add_locked() ORTHONAV_REQUIRES(mutex_) { ++count_; }

  Mutex mutex_;
  ConditionVariable changed_;
  int count_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav
