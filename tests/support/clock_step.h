#pragma once

#include <chrono>

namespace orthonav::test {

/// From now on this machine's wall clock is told this much earlier to this program, until it is
/// destroyed. The program links the object orthonav_clock_step, whose functions take the place of
/// the C library's; steady clocks go on as ever.
class ClockSetBack {
 public:
  explicit ClockSetBack(std::chrono::seconds by);
  ~ClockSetBack();
  ClockSetBack(const ClockSetBack&) = delete;
  ClockSetBack& operator=(const ClockSetBack&) = delete;
};

}  // namespace orthonav::test
