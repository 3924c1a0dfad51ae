#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"

namespace orthonav::igtl {

/// Converts a message's stamp to our own clock. No message arrives before it was stamped, so the
/// one with the shortest transit time so far gives the offset between the clocks. Clocks drift by
/// at most 100 parts per million, so the offset may not grow faster than that: messages that arrive
/// later and later are old, not stamped by a slow clock. The shortest transit time itself is
/// unknown and taken as zero.
class SenderClock {
 public:
  /// Never later than `arrived`, which must never decrease. A stamp of zero means unknown and gives
  /// `arrived`.
  [[nodiscard]] Timestamp time_of(std::uint64_t stamp, Timestamp arrived);
  /// How much longer the last message took than the fastest one.
  [[nodiscard]] Duration late() const { return late_; }
  /// For another sender, or a restarted one.
  void forget() { *this = {}; }

 private:
  std::optional<std::int64_t> offset_ns_;  ///< our time minus the sender's
  Timestamp known_at_{};
  Duration late_{};
};

}  // namespace orthonav::igtl
