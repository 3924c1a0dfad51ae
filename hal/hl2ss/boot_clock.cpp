#include "hal/hl2ss/boot_clock.h"

#include <algorithm>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

using std::chrono::duration_cast;

constexpr std::int64_t kTicksPerSecond = 10'000'000;
/// Longer than any network delay, and shorter than a restart takes.
constexpr std::int64_t kMaxAstrayTicks = 10 * kTicksPerSecond;
/// After this many stamps that agree with one another but not with the past, the clock was reset.
constexpr int kRestartAfter = 20;
/// Stamps from here on are FILETIME and are counted from 1970, as in recordings.
constexpr std::int64_t kUnixEpochTicks = 116444736000000000;

std::int64_t ns_of(HostTime at) {
  return duration_cast<std::chrono::nanoseconds>(at.time_since_epoch()).count();
}

}  // namespace

bool StampReader::follows(const Heard& last, const Heard& next) {
  const std::int64_t passed = duration_cast<Duration>(next.at - last.at).count() / 100;
  return next.ticks >= last.ticks - kMaxAstrayTicks &&
         next.ticks <= last.ticks + passed + kMaxAstrayTicks;
}

std::optional<StampReader::Heard> StampReader::heard_at(std::uint64_t ticks, HostTime at) {
  if (ticks > static_cast<std::uint64_t>(kUnixEpochTicks + kMaxTicks)) {
    return std::nullopt;
  }
  return Heard{static_cast<std::int64_t>(ticks), at};
}

std::optional<Timestamp> StampReader::time_of(const Heard& heard) const {
  const std::int64_t time_ticks = heard.ticks - base_ticks_ + offset_ticks_;
  if (time_ticks < -kMaxTicks || time_ticks > kMaxTicks) {
    return std::nullopt;
  }
  return from_ticks_100ns(time_ticks);
}

std::optional<Timestamp> StampReader::time_of(std::uint64_t ticks, HostTime at) {
  const auto now = heard_at(ticks, at);
  if (!now) {
    return std::nullopt;
  }
  if (!last_) {
    base_ticks_ = now->ticks >= kMaxTicks ? kUnixEpochTicks : 0;
  }
  const bool is_astray = last_ && !follows(*last_, *now);
  if (is_astray) {
    doubted_in_a_row_ = doubted_ && follows(*doubted_, *now) ? doubted_in_a_row_ + 1 : 1;
    doubted_ = now;
    if (doubted_in_a_row_ < kRestartAfter) {
      return std::nullopt;
    }
    const std::int64_t passed = duration_cast<Duration>(at - last_->at).count() / 100;
    offset_ticks_ += last_->ticks + passed - now->ticks;
    ++restarts_;
  }
  doubted_in_a_row_ = 0;
  doubted_.reset();
  if (!last_ || is_astray || now->ticks > last_->ticks) {
    last_ = now;
  }
  return time_of(*now);
}

std::optional<Timestamp> StampReader::told(std::uint64_t ticks, HostTime at) const {
  const auto now = heard_at(ticks, at);
  return last_ && now && follows(*last_, *now) ? time_of(*now) : std::nullopt;
}

void StampReader::set_by(Duration by) {
  set_by_ += by;
  offset_ticks_ -= by / Duration(100);
  ++restarts_;
}

std::optional<std::int64_t> BootClock::best_offset_ns() const {
  std::optional<std::int64_t> best;
  for (const Second& second : seconds_) {
    if (second.number > newest_second_ - static_cast<std::int64_t>(kSeconds) &&
        second.number >= 0) {
      best = std::max(best.value_or(second.offset_ns), second.offset_ns);
    }
  }
  return best;
}

Timestamp BootClock::now() const {
  const MutexLock lock(mutex_);
  const auto offset_ns = best_offset_ns();
  if (paced_) {
    last_ = std::max(last_, *paced_);
  } else if (offset_ns) {
    const Duration trip = shortest_trip_.value_or(Duration::zero());
    last_ = std::max(last_, Timestamp(Duration(ns_of(HostClock::now()) + *offset_ns) + trip / 2));
  }
  return last_;
}

void BootClock::heard(Timestamp stamp, HostTime at) {
  const MutexLock lock(mutex_);
  const std::int64_t offset_ns = stamp.time_since_epoch().count() - ns_of(at);
  const std::int64_t number = ns_of(at) / 1'000'000'000;
  Second& second = seconds_[static_cast<std::size_t>(number) % kSeconds];
  second = {number, second.number == number ? std::max(second.offset_ns, offset_ns) : offset_ns};
  newest_second_ = std::max(newest_second_, number);
  if (!paced_) {
    last_ = std::max(last_, stamp);
  }
}

void BootClock::round_trip(Duration took) {
  const MutexLock lock(mutex_);
  shortest_trip_ = std::min(shortest_trip_.value_or(took), took);
}

bool BootClock::runs_by_itself() const {
  const MutexLock lock(mutex_);
  return !paced_;
}

void BootClock::restart() {
  const MutexLock lock(mutex_);
  seconds_ = {};
}

void BootClock::paced(Timestamp now, HostTime at) {
  const MutexLock lock(mutex_);
  paced_ = now;
  // The point from which it continues if pacing ends.
  seconds_ = {};
  newest_second_ = ns_of(at) / 1'000'000'000;
  seconds_[static_cast<std::size_t>(newest_second_) % kSeconds] = {
      newest_second_, now.time_since_epoch().count() - ns_of(at)};
}

void BootClock::unpaced() {
  const MutexLock lock(mutex_);
  paced_.reset();
}

Duration BootClock::offset() const {
  const MutexLock lock(mutex_);
  return Duration(best_offset_ns().value_or(0));
}

Duration BootClock::spread() const {
  const MutexLock lock(mutex_);
  const auto best = best_offset_ns();
  std::int64_t worst = best.value_or(0);
  for (const Second& second : seconds_) {
    if (second.number > newest_second_ - static_cast<std::int64_t>(kSeconds) &&
        second.number >= 0) {
      worst = std::min(worst, second.offset_ns);
    }
  }
  return Duration(best.value_or(0) - worst);
}

}  // namespace orthonav::hl2ss
