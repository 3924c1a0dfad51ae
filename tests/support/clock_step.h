#pragma once

#include <chrono>

namespace orthonav::test {

/// While it exists, this program sees the machine's wall clock set back by this much. The program
/// links the object orthonav_clock_step, whose functions take the place of the C library's; steady
/// clocks are not affected.
class ClockSetBack {
 public:
  explicit ClockSetBack(std::chrono::seconds by);
  ~ClockSetBack();
  ClockSetBack(const ClockSetBack&) = delete;
  ClockSetBack& operator=(const ClockSetBack&) = delete;
};

}  // namespace orthonav::test
