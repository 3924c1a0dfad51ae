#include "hal/hl2ss/connection.h"

#include <poll.h>

#include <algorithm>
#include <utility>

namespace orthonav::hl2ss {
namespace {

constexpr Duration kLongestPause = std::chrono::seconds(2);
constexpr Duration kConnectWithin = std::chrono::seconds(3);
/// Reads of one turn, so that one stream can't starve the others.
constexpr int kReadsATurn = 16;
constexpr Duration kGoodbyeWithin = std::chrono::milliseconds(100);
constexpr std::size_t kMaxUnsent = std::size_t{1} << 20;

}  // namespace

short Connection::events() const {
  if (state_ == State::kConnecting) {
    return POLLOUT;
  }
  if (state_ == State::kPausing) {
    return 0;
  }
  return static_cast<short>(unsent_.empty() ? POLLIN : POLLIN | POLLOUT);
}

void Connection::step(short revents, HostTime now) {
  if (state_ == State::kPausing && now >= due_) {
    begin(now);
  }
  if (state_ == State::kConnecting) {
    if ((revents & (POLLOUT | POLLERR | POLLHUP)) != 0) {
      return finish_connecting(now);
    }
    if (now >= due_) {
      return drop("does not answer", now);
    }
  }
  if (state_ != State::kConnected) {
    return;
  }
  if (const Status late = protocol_.overdue(now); !late) {
    cut_off(socket_);
    return drop(late.error().message, now);
  }
  say_more(now);
  if ((revents & (POLLIN | POLLERR | POLLHUP)) != 0) {
    read(now);
    if (state_ == State::kConnected) {
      say_more(now);  // an answer may be what the next question waited for
    }
  }
  if (state_ == State::kConnected && now - heard_ > options_.longest_silence) {
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
  if (state_ != State::kConnected) {
    return;
  }
  const auto goodbye = protocol_.goodbye();
  if (goodbye.empty()) {
    return;
  }
  unsent_.insert(unsent_.end(), goodbye.begin(), goodbye.end());
  write();
  finish_sending(socket_, HostClock::now() + kGoodbyeWithin);
}

void Connection::begin(HostTime now) {
  auto socket = begin_connect(host_, options_.port);
  if (!socket) {
    return drop(socket.error().message, now);
  }
  socket_ = std::move(*socket);
  state_ = State::kConnecting;
  due_ = now + kConnectWithin;
  heard_ = now;
}

void Connection::finish_connecting(HostTime now) {
  if (const Status connected = connect_outcome(socket_); !connected) {
    return drop(connected.error().message, now);
  }
  round_trip_ = std::chrono::duration_cast<Duration>(HostClock::now() - heard_);
  state_ = State::kConnected;
  heard_ = now;
  meter_.connected();
  unsent_ = protocol_.opening();
  write();
}

void Connection::read(HostTime now) {
  for (int i = 0; i < kReadsATurn; ++i) {
    const auto room = protocol_.room();
    const auto count = receive_some(socket_, room);
    if (!count) {
      return drop(count.error().message, now);
    }
    if (*count == 0) {
      return;
    }
    const HostTime at = HostClock::now();
    heard_ = at;
    pause_ = kFirstPause;
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
  const auto count = send_some(socket_, unsent_);
  if (!count) {
    return;  // reading tells the same, with whatever came before it
  }
  unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(*count));
}

void Connection::drop(const std::string& why, HostTime now) {
  const bool was_connected = state_ == State::kConnected;
  socket_ = net::Socket();
  state_ = State::kPausing;
  due_ = now + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
  unsent_.clear();
  meter_.trouble("port " + std::to_string(options_.port) + ": " + why);
  if (was_connected) {
    protocol_.disconnected();
  }
}

}  // namespace orthonav::hl2ss
