#include "hal/igtl/link.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <algorithm>
#include <utility>

namespace orthonav::igtl {
namespace {

constexpr std::chrono::milliseconds kLongestPause{2000};
constexpr auto kConnectWithin = std::chrono::seconds(3);

/// A tracker whose tools are all out of sight says nothing for as long as that lasts, so silence
/// alone is no loss. A machine that is gone is found within ten seconds.
void keep_alive(int fd) {
  const auto set = [fd](int level, int option, int value) {
    (void)::setsockopt(fd, level, option, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 4);
  set(IPPROTO_TCP, TCP_KEEPINTVL, 2);
  set(IPPROTO_TCP, TCP_KEEPCNT, 3);
}

}  // namespace

short Link::events() const {
  return state_ == State::kConnecting ? POLLOUT : state_ == State::kConnected ? POLLIN : 0;
}

bool Link::step(short revents, HostTime now) {
  if (state_ == State::kPausing && now >= due_) {
    begin(now);
  }
  if (state_ != State::kConnecting) {
    return false;
  }
  if ((revents & (POLLOUT | POLLERR | POLLHUP)) != 0) {
    if (const Status connected = connect_outcome(socket_); !connected) {
      drop(connected.error().message, now);
      return false;
    }
    keep_alive(socket_.fd());
    state_ = State::kConnected;
    return true;
  }
  if (now >= due_) {
    drop("does not answer", now);
  }
  return false;
}

void Link::begin(HostTime now) {
  auto socket = net::begin_connect(host_, port_);
  if (!socket) {
    return drop(socket.error().message, now);
  }
  socket_ = std::move(*socket);
  state_ = State::kConnecting;
  due_ = now + kConnectWithin;
}

Result<std::size_t> Link::receive(std::span<std::uint8_t> room) {
  auto count = net::receive_some(socket_, room);
  if (count && *count > 0) {
    pause_ = kFirstPause;
  }
  return count;
}

void Link::drop(const std::string& why, HostTime now) {
  socket_ = net::Socket();
  state_ = State::kPausing;
  due_ = now + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
  trouble_ = why;
}

}  // namespace orthonav::igtl
