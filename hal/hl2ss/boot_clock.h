#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/mutex.h"
#include "base/time.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// Times out of a headset's stamps. A stamp may be early or late by what a network does; one that
/// lies elsewhere is damage, unless all that follow agree with it: then the headset was restarted
/// and its clock began anew, and times go on from where they were.
class StampReader {
 public:
  /// The device's time of a stamp in ticks of 100 ns that came at `at`; nothing for damage.
  [[nodiscard]] std::optional<Timestamp> time_of(std::uint64_t ticks, HostTime at);
  /// The same without updating anything; nothing for a stamp far from those heard so far.
  [[nodiscard]] std::optional<Timestamp> told(std::uint64_t ticks, HostTime at) const;
  /// What time zero of the device's times is called in stamps; known from the first on.
  [[nodiscard]] std::int64_t base_ticks() const { return base_ticks_; }
  [[nodiscard]] std::int64_t restarts() const { return restarts_; }

 private:
  struct Heard {
    std::int64_t ticks = 0;
    HostTime at{};
  };
  [[nodiscard]] static bool follows(const Heard& last, const Heard& next);
  /// Nothing for what is no stamp.
  [[nodiscard]] static std::optional<Heard> heard_at(std::uint64_t ticks, HostTime at);
  /// Nothing where the device's times end.
  [[nodiscard]] std::optional<Timestamp> time_of(const Heard& heard) const;

  std::int64_t base_ticks_ = 0;
  std::int64_t shift_ticks_ = 0;
  std::optional<Heard> last_;
  std::optional<Heard> doubted_;
  int doubted_in_a_row_ = 0;
  std::int64_t restarts_ = 0;
};

/// The headset's clock as this machine knows it: each packet was sent no earlier than it was
/// stamped, so that the one underway for the shortest time tells the offset best; the smallest
/// round trip's half is added. What a headset needs from stamp to sending stays unknown: the clock
/// is that much late. The offset of the last ten seconds counts, since clocks drift. Thread-safe.
class BootClock : public Clock {
 public:
  [[nodiscard]] Timestamp now() const override;
  /// A packet with this time came.
  void heard(Timestamp stamp, HostTime at);
  void round_trip(Duration took);
  /// From now on the clock stands at `now` until the next such call, while they come: a stand-in
  /// waits for its client and its time passes only with the pairs.
  void paced(Timestamp now, HostTime at);
  /// It no longer waits.
  void unpaced();

  [[nodiscard]] Duration offset() const;
  /// Largest minus smallest offset of the seconds that count.
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
