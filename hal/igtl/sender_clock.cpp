#include "hal/igtl/sender_clock.h"

#include <algorithm>

namespace orthonav::igtl {
namespace {

constexpr std::int64_t kDriftOneIn = 10'000;

/// Below 2^32 s, so it fits.
std::int64_t nanoseconds_of(std::uint64_t stamp) {
  constexpr std::uint64_t kPerSecond = 1'000'000'000;
  const std::uint64_t fraction = stamp & 0xffffffffu;
  return static_cast<std::int64_t>((stamp >> 32u) * kPerSecond + (fraction * kPerSecond >> 32u));
}

}  // namespace

Timestamp SenderClock::time_of(std::uint64_t stamp, Timestamp arrived) {
  if (stamp == 0) {
    late_ = {};
    return arrived;
  }
  const std::int64_t sent_ns = nanoseconds_of(stamp);
  const std::int64_t arrived_ns = Duration(arrived.time_since_epoch()).count();
  const std::int64_t offset_ns = arrived_ns - sent_ns;
  const std::int64_t drift_ns = Duration(arrived - known_at_).count() / kDriftOneIn;
  offset_ns_ = offset_ns_ ? std::min(offset_ns, *offset_ns_ + drift_ns) : offset_ns;
  known_at_ = arrived;
  late_ = Duration(offset_ns - *offset_ns_);
  return arrived - late_;
}

}  // namespace orthonav::igtl
