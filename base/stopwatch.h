#pragma once

#include <chrono>

namespace orthonav {

/// Wall time since construction, for measuring how long work takes and for ending waits. Apart from
/// devices, only this class and `WallClock` read a clock; no result may depend on them.
class Stopwatch {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  [[nodiscard]] std::chrono::nanoseconds elapsed() const {
    return std::chrono::steady_clock::now() - start_;
  }
  [[nodiscard]] double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(elapsed()).count();
  }
  /// The wall time at which `duration` will have elapsed, as a condition variable takes it.
  [[nodiscard]] WallTime after(std::chrono::nanoseconds duration) const {
    return start_ + duration;
  }

 private:
  WallTime start_ = std::chrono::steady_clock::now();
};

}  // namespace orthonav
