#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.h"

namespace orthonav::igtl {

/// Converts a message's stamp to our own clock. No message arrives before it was stamped, so the
/// one with the shortest transit time so far gives the offset between the clocks. Clocks drift by
/// at most 100 parts per million, so the offset may not grow faster than that: messages that arrive
/// later and later are old, not stamped by a slow clock. The shortest transit time itself is
/// unknown and taken as zero.
///
/// A clock may be set, though, by a person or by NTP. Back: the stamps of a device then run
/// backwards, or come closer together than they ever did while messages arrive as before; a delay
/// does neither. Forward: messages seem faster than the fastest one, beyond what a network varies.
/// Either begins a doubt, in which no time is known, and which ends when messages fit the clock as
/// it was (one was merely stamped wrongly) or, after a while, with the clock as it is now. A delay
/// that all messages had before is taken to be in them still.
class SenderClock {
 public:
  /// Steps of a clock that are no larger are a network's noise: they pass for a delay.
  static constexpr Duration kSmallestStep = std::chrono::milliseconds(20);
  /// How long messages are watched before the fastest of them tells the new offset.
  static constexpr Duration kSettle = std::chrono::milliseconds(500);
  /// Only then is the fastest message known well enough for a faster one to be remarkable.
  static constexpr int kEnoughMessages = 30;
  static constexpr Duration kTooLate = std::chrono::milliseconds(100);
  static constexpr Duration kTooLateFor = std::chrono::seconds(5);

  /// Never later than `arrived`, which must never decrease. A stamp of zero means unknown and gives
  /// `arrived`. Stamps of different devices need not be in order.
  [[nodiscard]] Timestamp time_of(std::uint64_t stamp, Timestamp arrived,
                                  const std::string& device = {});
  /// Whether the last time is one: not while the clock is in doubt.
  [[nodiscard]] bool known() const { return !doubt_; }
  /// How much longer the last message took than the fastest one.
  [[nodiscard]] Duration late() const { return late_; }
  /// Whether messages have been later than `kTooLate` for `kTooLateFor`: guidance on them is
  /// hidden. A new connection removes the cause, if it is a queue on the way or a clock that is
  /// slowed down.
  [[nodiscard]] bool wants_new_connection() const { return late_for_ > kTooLateFor; }
  /// By how much the clock was set, forward if positive: once, when it is known again.
  [[nodiscard]] std::optional<Duration> take_step();
  /// For another sender, or a restarted one.
  void forget() { *this = {}; }

 private:
  /// The newest message of a device.
  struct Newest {
    std::string device;
    std::int64_t sent_ns = 0;
    std::int64_t arrived_ns = 0;
    std::int64_t interval_ns = 0;  ///< the shortest lately between two stamps; 0: unknown
  };
  struct Doubt {
    std::int64_t since_ns = 0;
    std::int64_t offset_ns = 0;   ///< of the fastest message since
    std::int64_t delayed_ns = 0;  ///< as all messages were before
    bool back = false;
  };
  /// Whether this stamp is earlier than the device's last one, or than its arrival explains.
  bool is_set_back(const std::string& device, std::int64_t sent_ns, std::int64_t arrived_ns);
  void doubt(std::int64_t offset_ns, std::int64_t arrived_ns, bool back);
  void settle(std::int64_t offset_ns, std::int64_t arrived_ns);
  /// Keeps the least delay of this half second and of the last one.
  void note_delay(std::int64_t delay_ns, std::int64_t arrived_ns);

  std::optional<std::int64_t> offset_ns_;  ///< our time minus the sender's
  std::int64_t known_at_ns_ = 0;
  int messages_ = 0;
  std::int64_t begun_ns_ = 0;
  Duration late_{};
  Duration late_for_{};
  std::vector<Newest> newest_;
  std::int64_t half_begun_ns_ = 0;
  std::int64_t least_now_ns_ = 0;
  std::int64_t least_before_ns_ = 0;
  std::optional<Doubt> doubt_;
  std::optional<Duration> step_;
};

}  // namespace orthonav::igtl
