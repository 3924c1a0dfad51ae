#pragma once

#include <chrono>
#include <cstdint>

namespace orthonav {

/// The headset's own clock. It counts nanoseconds from an epoch of the device's choosing and never
/// mixes with wall time. There is no now(): only a device or a Clock object reads a clock.
struct DeviceClock {
  using rep = std::int64_t;
  using period = std::nano;
  using duration = std::chrono::nanoseconds;
  using time_point = std::chrono::time_point<DeviceClock>;
  static constexpr bool is_steady = true;
};
using Timestamp = DeviceClock::time_point;
using Duration = DeviceClock::duration;

/// Files hold ticks of 100 ns; Headset::file_ticks_100ns adds the device's epoch. Rounds down.
[[nodiscard]] constexpr std::int64_t ticks_100ns(Timestamp t) {
  const std::int64_t ns = t.time_since_epoch().count();
  return ns / 100 - (ns % 100 < 0 ? 1 : 0);
}
[[nodiscard]] constexpr Timestamp from_ticks_100ns(std::int64_t ticks) {
  return Timestamp(Duration(ticks * 100));
}
[[nodiscard]] constexpr double seconds(Duration d) { return static_cast<double>(d.count()) * 1e-9; }
[[nodiscard]] constexpr Duration from_seconds(double s) {
  return Duration(static_cast<std::int64_t>(s * 1e9 + (s < 0 ? -0.5 : 0.5)));
}

/// Reads the device's time. Injected wherever time is needed; thread-safe.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual Timestamp now() const = 0;
  /// Whether time passes by itself. Otherwise pairs advance it: while the next pair waits, so does
  /// time.
  [[nodiscard]] virtual bool runs_by_itself() const { return true; }
};

}  // namespace orthonav
