#include "hal/hl2ss/connection.h"

#include <poll.h>

namespace orthonav::hl2ss {
namespace {

/// Reads per turn, so that one stream can't starve the others.
constexpr int kReadsATurn = 16;
constexpr Duration kGoodbyeWithin = std::chrono::milliseconds(100);
constexpr std::size_t kMaxUnsent = std::size_t{1} << 20;

}  // namespace

short Connection::events() const {
  const short wanted = link_.events();
  return static_cast<short>(is_connected() && !unsent_.empty() ? wanted | POLLOUT : wanted);
}

void Connection::step(short revents, HostTime now) {
  switch (link_.step(revents, now)) {
    case net::Link::Step::kConnected:
      return connected(now);
    case net::Link::Step::kFailed:
      return tell_trouble();
    case net::Link::Step::kNothing:
      break;
  }
  if (!is_connected()) {
    return;
  }
  if (const Status late = protocol_.overdue(now); !late) {
    cut_off(link_.socket());
    return drop(late.error().message, now);
  }
  say_more(now);
  if ((revents & (POLLIN | POLLERR | POLLHUP)) != 0) {
    read(now);
    if (is_connected()) {
      say_more(now);  // the next request may have been waiting for this answer
    }
  }
  if (is_connected() && now - heard_ > options_.longest_silence) {
    drop("silent for " + std::to_string(seconds(now - heard_)) + " s", now);
  }
}

void Connection::say_more(HostTime now) {
  const auto more = protocol_.more(now);
  if (unsent_.size() + more.size() <= kMaxUnsent) {
    unsent_.insert(unsent_.end(), more.begin(), more.end());
  }
  write();
}

void Connection::leave() {
  if (!is_connected()) {
    return;
  }
  const auto goodbye = protocol_.goodbye();
  if (goodbye.empty()) {
    return;
  }
  unsent_.insert(unsent_.end(), goodbye.begin(), goodbye.end());
  write();
  finish_sending(link_.socket(), HostClock::now() + kGoodbyeWithin);
}

void Connection::connected(HostTime now) {
  heard_ = now;
  meter_.connected();
  unsent_ = protocol_.opening();
  write();
}

void Connection::read(HostTime now) {
  for (int i = 0; i < kReadsATurn; ++i) {
    const auto room = protocol_.room();
    const auto count = link_.receive(room);
    if (!count) {
      return drop(count.error().message, now);
    }
    if (*count == 0) {
      return;
    }
    const HostTime at = HostClock::now();
    heard_ = at;
    meter_.received(*count);
    if (const Status understood = protocol_.received(*count, at); !understood) {
      meter_.damaged(understood.error().message);
      return drop(understood.error().message, now);
    }
  }
}

void Connection::write() {
  if (unsent_.empty()) {
    return;
  }
  const auto count = send_some(link_.socket(), unsent_);
  if (!count) {
    return;  // reading reports the same error, after the bytes that came before it
  }
  unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(*count));
}

void Connection::drop(const std::string& why, HostTime now) {
  link_.drop(why, now);
  unsent_.clear();
  tell_trouble();
  protocol_.disconnected();
}

void Connection::tell_trouble() {
  meter_.trouble("port " + std::to_string(options_.port) + ": " + link_.trouble());
}

}  // namespace orthonav::hl2ss
