#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/mutex.h"
#include "base/time.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// Converts a headset's stamps to times. A stamp may be early or late by a network's delays; one
/// farther off is damage, unless all later stamps agree with it: then the headset was restarted and
/// its clock reset, and times continue from where they were.
class StampReader {
 public:
  /// The device's time for a stamp in ticks of 100 ns that arrived at `at`; nothing for damage.
  [[nodiscard]] std::optional<Timestamp> time_of(std::uint64_t ticks, HostTime at);
  /// The same without updating anything; nothing for a stamp far from those received so far.
  [[nodiscard]] std::optional<Timestamp> told(std::uint64_t ticks, HostTime at) const;
  /// The headset's clock was set by this: times go on as if it had not been.
  void set_by(Duration by);
  /// A time as it would be had the clock never been set.
  [[nodiscard]] Timestamp as_stamped(Timestamp time) const { return time + set_by_; }
  /// The stamp that corresponds to time zero of the device; known from the first stamp on.
  [[nodiscard]] std::int64_t base_ticks() const { return base_ticks_; }
  [[nodiscard]] std::int64_t restarts() const { return restarts_; }

 private:
  struct Heard {
    std::int64_t ticks = 0;
    HostTime at{};
  };
  [[nodiscard]] static bool follows(const Heard& last, const Heard& next);
  /// Nothing for an invalid stamp.
  [[nodiscard]] static std::optional<Heard> heard_at(std::uint64_t ticks, HostTime at);
  /// Nothing beyond the range of the device's times.
  [[nodiscard]] std::optional<Timestamp> time_of(const Heard& heard) const;

  std::int64_t base_ticks_ = 0;
  std::int64_t offset_ticks_ = 0;
  std::optional<Heard> last_;
  std::optional<Heard> doubted_;
  int doubted_in_a_row_ = 0;
  std::int64_t restarts_ = 0;
  Duration set_by_{};
};

/// The headset's clock as estimated on this machine: each packet was sent no earlier than it was
/// stamped, so the one with the shortest transit time gives the best offset; half of the smallest
/// round trip is added. The headset's delay from stamping to sending is unknown, so the clock is
/// late by that much. Only the last ten seconds count, since clocks drift. Thread-safe.
class BootClock : public Clock {
 public:
  [[nodiscard]] Timestamp now() const override;
  /// Not while it is paced.
  [[nodiscard]] bool runs_by_itself() const override;
  /// A packet with this time arrived.
  void heard(Timestamp stamp, HostTime at);
  void round_trip(Duration took);
  /// Earlier stamps mean nothing any more.
  void restart();
  /// As long as these calls keep coming, the clock stands at `now` until the next one: a stand-in
  /// waits for its client, and its time advances only with the pairs.
  void paced(Timestamp now, HostTime at);
  /// The stand-in no longer waits.
  void unpaced();

  [[nodiscard]] Duration offset() const;
  /// Largest minus smallest offset in the seconds that count.
  [[nodiscard]] Duration spread() const;

 private:
  static constexpr std::size_t kSeconds = 10;
  struct Second {
    std::int64_t number = -1;
    std::int64_t offset_ns = 0;
  };
  [[nodiscard]] std::optional<std::int64_t> best_offset_ns() const ORTHONAV_REQUIRES(mutex_);

  mutable Mutex mutex_;
  std::array<Second, kSeconds> seconds_ ORTHONAV_GUARDED_BY(mutex_){};
  std::int64_t newest_second_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::optional<Duration> shortest_trip_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Timestamp> paced_ ORTHONAV_GUARDED_BY(mutex_);
  mutable Timestamp last_ ORTHONAV_GUARDED_BY(mutex_){};
};

}  // namespace orthonav::hl2ss
