#include "tests/support/clock_step.h"

#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <ctime>

namespace {

std::atomic<std::int64_t> g_back_s{0};

}  // namespace

// Replaces the C library's function; calls the kernel directly.
extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int problem = static_cast<int>(::syscall(SYS_clock_gettime, clock, now));
  if (problem == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) {
    now->tv_sec -= g_back_s;
  }
  return problem;
}

int gettimeofday(timeval* now, void* /*zone*/) noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  *now = {time.tv_sec, static_cast<suseconds_t>(time.tv_nsec / 1000)};
  return 0;
}

time_t time(time_t* out) noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  if (out != nullptr) {
    *out = now.tv_sec;
  }
  return now.tv_sec;
}
}

namespace orthonav::test {

ClockSetBack::ClockSetBack(std::chrono::seconds by) { g_back_s = by.count(); }
ClockSetBack::~ClockSetBack() { g_back_s = 0; }

}  // namespace orthonav::test
