#include "base/mutex.h"

namespace orthonav {

class Count {
 public:
  int read() const {
    // finding: reading variable 'count_' requires holding mutex 'mutex_'
    return count_;
  }
  void write() {
    // finding: writing variable 'count_' requires holding mutex 'mutex_' exclusively
    count_ = 1;
  }
  void add() {
    // finding: calling function 'add_locked' requires holding mutex 'mutex_' exclusively
    add_locked();
  }
  void add_twice() {
    const MutexLock lock(mutex_);
    // finding: cannot call function 'take_and_add' while mutex 'mutex_' is held
    take_and_add();
    // finding: acquiring mutex 'mutex_' that is already held
    const MutexLock again(mutex_);
  }
  void wait() {
    // finding: calling function 'wait' requires holding mutex 'mutex_' exclusively
    changed_.wait(mutex_);
  }

 private:
  void add_locked() ORTHONAV_REQUIRES(mutex_) { ++count_; }
  void take_and_add() ORTHONAV_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    add_locked();
  }

  mutable Mutex mutex_;
  ConditionVariable changed_;
  int count_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

}  // namespace orthonav
