#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"

namespace orthonav::igtl {

/// When a message was stamped, by our own clock. The sender's clock is another one, and what is
/// known of it is that no message arrives before it was stamped: the one that was under way for
/// the shortest time so far tells the offset. Clocks drift by at most 100 parts in a million, so
/// that the offset may not grow faster: messages that come later and later are old, not stamped by
/// a slow clock. The shortest time under way itself is not known; it counts as none.
class SenderClock {
 public:
  /// Never past `arrived`, which never goes back. A stamp of zero says nothing: it is `arrived`.
  [[nodiscard]] Timestamp time_of(std::uint64_t stamp, Timestamp arrived);
  /// How much longer the last message was under way than the fastest one.
  [[nodiscard]] Duration late() const { return late_; }
  /// Another sender, or the same one anew.
  void forget() { *this = {}; }

 private:
  std::optional<std::int64_t> offset_ns_;  ///< our time minus the sender's
  Timestamp known_at_{};
  Duration late_{};
};

}  // namespace orthonav::igtl
