#include "hal/hl2ss/standin_stream.h"

#include <algorithm>

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kMaxUpTo = 256;

}  // namespace

std::span<std::uint8_t> StandinStream::room() {
  buffer_.resize(std::max<std::size_t>(buffer_.size(), 2 * have_ + 4096));
  return std::span(buffer_).subspan(have_);
}

Status StandinStream::received(std::size_t count, HostTime /*at*/) {
  have_ += count;
  std::size_t used = 0;
  Status status;
  while (status.ok()) {
    const auto read = read_standin_message(Bytes(buffer_).subspan(used, have_ - used));
    if (!read) {
      status = read.error();
    } else if (*read) {
      status = take((*read)->message);
      used += (*read)->bytes;
    } else {
      break;
    }
  }
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(used),
            buffer_.begin() + static_cast<std::ptrdiff_t>(have_), buffer_.begin());
  have_ -= used;
  return status;
}

Status StandinStream::take(const StandinMessage& message) {
  const MutexLock lock(mutex_);
  if (const auto* hello = std::get_if<StandinHello>(&message)) {
    hello_ = *hello;
    may_repeat_ = hello->may_repeat;
    if (hello->paced) {
      time_.clock.paced(hello->clock, HostClock::now());
    }
    return {};
  }
  if (!hello_) {
    return Error{"stand-in: the greeting must come first"};
  }
  if (const auto* clicks = std::get_if<StandinClicks>(&message)) {
    for (const ClickerEvent& event : clicks->events) {
      // Events come in order; those of a server that began anew lie in the past until its time
      // has caught up.
      (void)inbox_.put(event);
    }
  } else if (const auto* up_to = std::get_if<StandinUpTo>(&message)) {
    if (up_to_.size() == kMaxUpTo) {
      up_to_.pop_front();
    }
    up_to_.push_back(*up_to);
  } else if (std::holds_alternative<StandinEnd>(message)) {
    ended_ = true;
  } else {
    return Error{"stand-in: a message that only a client sends"};
  }
  return {};
}

void StandinStream::send(const StandinMessage& message) {
  {
    const MutexLock lock(mutex_);
    // Not connected, or the other side is too slow: even the newest message is not kept.
    if (!hello_ || unsent_.size() > kMaxStandinBytes) {
      return;
    }
    append(unsent_, message);
  }
  wake_up_.wake();
}

std::vector<std::uint8_t> StandinStream::more(HostTime /*now*/) {
  const MutexLock lock(mutex_);
  return std::exchange(unsent_, {});
}

void StandinStream::disconnected() {
  have_ = 0;
  const MutexLock lock(mutex_);
  hello_.reset();
  up_to_.clear();
  unsent_.clear();
  time_.clock.unpaced();
}

bool StandinStream::admits(Timestamp pair_time) {
  const MutexLock lock(mutex_);
  if (!hello_) {
    return true;
  }
  while (!up_to_.empty() && up_to_.front().pair_time < pair_time) {
    up_to_.pop_front();
  }
  if (up_to_.empty()) {
    return false;
  }
  if (hello_->paced && up_to_.front().pair_time == pair_time) {
    time_.clock.paced(up_to_.front().clock, HostClock::now());
  }
  return true;
}

bool StandinStream::is_paced() const {
  const MutexLock lock(mutex_);
  return hello_ && hello_->paced;
}

bool StandinStream::has_ended() const {
  const MutexLock lock(mutex_);
  return ended_;
}

std::optional<Duration> StandinStream::display_latency() const {
  const MutexLock lock(mutex_);
  return hello_ ? std::optional(hello_->display_latency) : std::nullopt;
}

MayRepeat StandinStream::may_repeat() const {
  const MutexLock lock(mutex_);
  return may_repeat_;
}

}  // namespace orthonav::hl2ss
