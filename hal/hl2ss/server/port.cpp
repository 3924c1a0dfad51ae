#include "hal/hl2ss/server/port.h"

#include <poll.h>

#include <algorithm>
#include <array>

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kMaxQueued = std::size_t{16} << 20;
constexpr std::size_t kMaxHeard = std::size_t{4} << 20;

}  // namespace

Status Port::listen(const net::Endpoint& host, int port, net::Allowed allowed) {
  auto listener = listen_at(host, port);
  if (!listener) {
    return listener.error();
  }
  listener_ = std::move(*listener);
  allowed_ = std::move(allowed);
  return {};
}

int Port::fd() const { return client_.is_open() ? client_.fd() : listener_.fd(); }

short Port::events() const {
  if (!client_.is_open()) {
    return POLLIN;
  }
  const MutexLock lock(mutex_);
  const bool speaks = !queue_.empty() && HostClock::now() >= silent_until_;
  return static_cast<short>(speaks ? POLLIN | POLLOUT : POLLIN);
}

void Port::step(short revents, HostTime now) {
  if (!client_.is_open()) {
    if ((revents & POLLIN) == 0) {
      return;
    }
    if (auto client = accept_one(listener_); client && allowed_.contains(peer_of(*client))) {
      client_ = std::move(*client);
      has_client_ = true;
      talk_.came();
    }
    return;
  }
  if ((revents & (POLLIN | POLLERR | POLLHUP)) != 0) {
    read();
  }
  if (client_.is_open()) {
    write(now);
  }
}

void Port::read() {
  std::array<std::uint8_t, 65536> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const auto count = receive_some(client_, bytes);
  if (!count) {
    return disconnect();
  }
  heard_.insert(heard_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(*count));
  while (!heard_.empty()) {
    const auto used = talk_.understand(heard_);
    if (!used || heard_.size() > kMaxHeard) {
      return disconnect();
    }
    if (*used == 0) {
      return;
    }
    heard_.erase(heard_.begin(), heard_.begin() + static_cast<std::ptrdiff_t>(*used));
  }
}

void Port::write(HostTime now) {
  bool closes = false;
  {
    const MutexLock lock(mutex_);
    while (!queue_.empty() && now >= silent_until_ && !closes) {
      Chunk& chunk = queue_.front();
      const auto count = send_some(client_, Bytes(chunk.bytes).subspan(sent_of_first_));
      sent_of_first_ += count ? *count : 0;
      if (!count || sent_of_first_ < chunk.bytes.size()) {
        break;
      }
      silent_until_ = now + chunk.pause;
      closes = chunk.close;
      queued_bytes_ -= chunk.bytes.size();
      sent_of_first_ = 0;
      queue_.pop_front();
    }
  }
  if (closes) {
    disconnect();
  }
}

void Port::disconnect() {
  client_ = net::Socket();
  has_client_ = false;
  heard_.clear();
  {
    const MutexLock lock(mutex_);
    queue_.clear();
    queued_bytes_ = 0;
    sent_of_first_ = 0;
    silent_until_ = {};
  }
  talk_.left();
}

void Port::send(std::vector<Chunk> chunks) {
  if (!has_client()) {
    return;
  }
  std::size_t bytes = 0;
  for (const Chunk& chunk : chunks) {
    bytes += chunk.bytes.size();
  }
  const MutexLock lock(mutex_);
  if (queued_bytes_ + bytes > kMaxQueued) {
    return;
  }
  queued_bytes_ += bytes;
  for (Chunk& chunk : chunks) {
    queue_.push_back(std::move(chunk));
  }
}

}  // namespace orthonav::hl2ss
