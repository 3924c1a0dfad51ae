#include "hal/net/link.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <algorithm>
#include <utility>

namespace orthonav::net {
namespace {

constexpr std::chrono::milliseconds kLongestPause{2000};
constexpr auto kConnectWithin = std::chrono::seconds(3);

}  // namespace

short Link::events() const {
  return state_ == State::kConnecting ? POLLOUT : state_ == State::kConnected ? POLLIN : 0;
}

Link::Step Link::step(short revents, HostTime now) {
  if (state_ == State::kPausing && now >= due_) {
    if (const Status begun = begin(now); !begun) {
      drop(begun.error().message, now);
      return Step::kFailed;
    }
  }
  if (state_ != State::kConnecting) {
    return Step::kNothing;
  }
  if ((revents & (POLLOUT | POLLERR | POLLHUP)) != 0) {
    if (const Status connected = connect_outcome(socket_); !connected) {
      drop(connected.error().message, now);
      return Step::kFailed;
    }
    round_trip_ = HostClock::now() - begun_;
    state_ = State::kConnected;
    return Step::kConnected;
  }
  if (now >= due_) {
    drop("does not answer", now);
    return Step::kFailed;
  }
  return Step::kNothing;
}

Status Link::begin(HostTime now) {
  auto socket = begin_connect(host_, port_);
  if (!socket) {
    return socket.error();
  }
  socket_ = std::move(*socket);
  state_ = State::kConnecting;
  begun_ = now;
  due_ = now + kConnectWithin;
  return {};
}

Result<std::size_t> Link::receive(std::span<std::uint8_t> room) {
  auto count = receive_some(socket_, room);
  if (count && *count > 0) {
    pause_ = kFirstPause;
  }
  return count;
}

void Link::drop(const std::string& why, HostTime now) {
  socket_ = Socket();
  state_ = State::kPausing;
  due_ = now + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
  trouble_ = why;
}

void keep_alive(const Socket& socket) {
  const auto set = [&socket](int level, int option, int value) {
    (void)::setsockopt(socket.fd(), level, option, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 4);
  set(IPPROTO_TCP, TCP_KEEPINTVL, 2);
  set(IPPROTO_TCP, TCP_KEEPCNT, 3);
}

}  // namespace orthonav::net
