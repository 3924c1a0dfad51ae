#include "hal/igtl/sender_clock.h"

#include <algorithm>
#include <utility>

namespace orthonav::igtl {
namespace {

constexpr std::int64_t kDriftOneIn = 10'000;
constexpr std::int64_t kStep_ns = SenderClock::kSmallestStep.count();
constexpr std::int64_t kSettle_ns = SenderClock::kSettle.count();
/// A sender with more devices than tools is not watched in all of them.
constexpr std::size_t kMaxDevices = 64;
/// Silence for longer says nothing about how late messages were meanwhile.
constexpr std::int64_t kPause_ns = 1'000'000'000;

/// Below 2^32 s, so it fits.
std::int64_t nanoseconds_of(std::uint64_t stamp) {
  constexpr std::uint64_t kPerSecond = 1'000'000'000;
  const std::uint64_t fraction = stamp & 0xffffffffu;
  return static_cast<std::int64_t>((stamp >> 32u) * kPerSecond + (fraction * kPerSecond >> 32u));
}

}  // namespace

Timestamp SenderClock::time_of(std::uint64_t stamp, Timestamp arrived, const std::string& device) {
  if (stamp == 0) {
    late_ = {};
    late_for_ = {};
    doubt_.reset();
    return arrived;
  }
  const std::int64_t sent_ns = nanoseconds_of(stamp);
  const std::int64_t arrived_ns = Duration(arrived.time_since_epoch()).count();
  const std::int64_t offset_ns = arrived_ns - sent_ns;
  if (!offset_ns_) {
    offset_ns_ = offset_ns;
    known_at_ns_ = begun_ns_ = half_begun_ns_ = arrived_ns;
  }
  const std::int64_t since_ns = arrived_ns - std::exchange(known_at_ns_, arrived_ns);
  *offset_ns_ += since_ns / kDriftOneIn;
  ++messages_;

  const std::int64_t delay_ns = offset_ns - *offset_ns_;
  const bool fits = delay_ns >= -kStep_ns && delay_ns <= kStep_ns;
  const bool back = is_set_back(device, sent_ns, arrived_ns);
  const bool settled = messages_ > kEnoughMessages && arrived_ns - begun_ns_ >= 2 * kSettle_ns;
  if (fits && (back || (doubt_ && doubt_->back))) {
    doubt_.reset();
  } else if (back) {
    doubt(offset_ns, arrived_ns, true);
  } else if (!doubt_ && settled && delay_ns < -kStep_ns) {
    doubt(offset_ns, arrived_ns, false);
  }
  if (doubt_) {
    settle(offset_ns, arrived_ns);
  } else {
    offset_ns_ = std::min(offset_ns, *offset_ns_);
  }
  late_ = Duration(std::max<std::int64_t>(offset_ns - *offset_ns_, 0));
  if (!doubt_) {
    note_delay(late_.count(), arrived_ns);
  }
  const bool still_late = late_ > kTooLate && !doubt_ && since_ns <= kPause_ns;
  late_for_ = still_late ? late_for_ + Duration(since_ns) : Duration::zero();
  return arrived - late_;
}

bool SenderClock::is_set_back(const std::string& device, std::int64_t sent_ns,
                              std::int64_t arrived_ns) {
  const auto at = std::find_if(newest_.begin(), newest_.end(),
                               [&](const Newest& each) { return each.device == device; });
  if (at == newest_.end()) {
    if (newest_.size() < kMaxDevices) {
      newest_.push_back({device, sent_ns, arrived_ns, 0});
    }
    return false;
  }
  const std::int64_t interval_ns = sent_ns - std::exchange(at->sent_ns, sent_ns);
  const std::int64_t short_by_ns =
      arrived_ns - std::exchange(at->arrived_ns, arrived_ns) - interval_ns;
  // A message that was delayed arrives later and is stamped as usual.
  const bool back =
      short_by_ns > kStep_ns &&
      (interval_ns < 0 || (at->interval_ns > 0 && interval_ns < at->interval_ns - short_by_ns / 2));
  if (!back && interval_ns > 0) {
    const std::int64_t longer_ns = at->interval_ns + at->interval_ns / 8;
    at->interval_ns = at->interval_ns > 0 ? std::min(interval_ns, longer_ns) : interval_ns;
  }
  return back;
}

void SenderClock::doubt(std::int64_t offset_ns, std::int64_t arrived_ns, bool back) {
  const std::int64_t delayed_ns =
      doubt_ ? doubt_->delayed_ns : std::min(least_now_ns_, least_before_ns_);
  doubt_ = Doubt{arrived_ns, offset_ns, delayed_ns, back};
}

void SenderClock::settle(std::int64_t offset_ns, std::int64_t arrived_ns) {
  doubt_->offset_ns = std::min(doubt_->offset_ns, offset_ns);
  if (arrived_ns - doubt_->since_ns < kSettle_ns) {
    return;
  }
  const std::int64_t now_ns = doubt_->offset_ns - doubt_->delayed_ns;
  step_ = Duration(*offset_ns_ - now_ns);
  offset_ns_ = now_ns;
  doubt_.reset();
}

void SenderClock::note_delay(std::int64_t delay_ns, std::int64_t arrived_ns) {
  if (arrived_ns - half_begun_ns_ >= kSettle_ns) {
    half_begun_ns_ = arrived_ns;
    least_before_ns_ = std::exchange(least_now_ns_, delay_ns);
  }
  least_now_ns_ = std::min(least_now_ns_, delay_ns);
}

std::optional<Duration> SenderClock::take_step() { return std::exchange(step_, std::nullopt); }

}  // namespace orthonav::igtl
