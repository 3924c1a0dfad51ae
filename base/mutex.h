#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

// Read by clang's -Wthread-safety; other compilers see nothing.
// https://clang.llvm.org/docs/ThreadSafetyAnalysis.html
#if defined(__clang__)
#define ORTHONAV_THREAD_ANNOTATION(attribute) __attribute__((attribute))
#else
#define ORTHONAV_THREAD_ANNOTATION(attribute)
#endif
#define ORTHONAV_CAPABILITY(name) ORTHONAV_THREAD_ANNOTATION(capability(name))
#define ORTHONAV_SCOPED_CAPABILITY ORTHONAV_THREAD_ANNOTATION(scoped_lockable)
/// On a function: it takes the mutex, or releases it.
#define ORTHONAV_ACQUIRE(...) ORTHONAV_THREAD_ANNOTATION(acquire_capability(__VA_ARGS__))
#define ORTHONAV_RELEASE(...) ORTHONAV_THREAD_ANNOTATION(release_capability(__VA_ARGS__))
/// On a member: read and written only while this mutex is held.
#define ORTHONAV_GUARDED_BY(mutex) ORTHONAV_THREAD_ANNOTATION(guarded_by(mutex))
/// On a function: the caller must hold the mutex.
#define ORTHONAV_REQUIRES(...) ORTHONAV_THREAD_ANNOTATION(requires_capability(__VA_ARGS__))
/// On a function that takes the mutex itself: the caller must not hold it.
#define ORTHONAV_EXCLUDES(...) ORTHONAV_THREAD_ANNOTATION(locks_excluded(__VA_ARGS__))
/// On a function that is correct for a reason that clang can't see; a comment there says why.
#define ORTHONAV_NO_THREAD_SAFETY_ANALYSIS ORTHONAV_THREAD_ANNOTATION(no_thread_safety_analysis)

namespace orthonav {

/// A std::mutex that clang's analysis knows: code that touches a guarded member without it is
/// refused.
class ORTHONAV_CAPABILITY("mutex") Mutex {
 public:
  void lock() ORTHONAV_ACQUIRE() { mutex_.lock(); }
  void unlock() ORTHONAV_RELEASE() { mutex_.unlock(); }

 private:
  friend class ConditionVariable;
  std::mutex mutex_;
};

/// Holds a mutex until the end of its block.
class ORTHONAV_SCOPED_CAPABILITY [[nodiscard]] MutexLock {
 public:
  explicit MutexLock(Mutex& mutex) ORTHONAV_ACQUIRE(mutex) : mutex_(mutex) { mutex_.lock(); }
  ~MutexLock() ORTHONAV_RELEASE() { mutex_.unlock(); }
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;

 private:
  Mutex& mutex_;
};

/// Waits come without a predicate, since clang doesn't know that a lambda runs under the mutex. A
/// wait may end for no reason, so it belongs in a loop:
/// `while (!done_) { changed_.wait(mutex_); }`
class ConditionVariable {
 public:
  void notify_one() { changed_.notify_one(); }
  void notify_all() { changed_.notify_all(); }

  /// Releases the mutex while it waits, and holds it again when it returns.
  void wait(Mutex& mutex) ORTHONAV_REQUIRES(mutex) {
    std::unique_lock lock(mutex.mutex_, std::adopt_lock);
    changed_.wait(lock);
    lock.release();
  }
  /// The same; returns false once `time` is reached.
  bool wait_until(Mutex& mutex, std::chrono::steady_clock::time_point time)
      ORTHONAV_REQUIRES(mutex) {
    std::unique_lock lock(mutex.mutex_, std::adopt_lock);
    const bool in_time = changed_.wait_until(lock, time) == std::cv_status::no_timeout;
    lock.release();
    return in_time;
  }

 private:
  std::condition_variable changed_;
};

}  // namespace orthonav
