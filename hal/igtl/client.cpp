#include "hal/igtl/client.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace orthonav::igtl {
namespace {

bool later(int code) { return code == EAGAIN || code == EWOULDBLOCK || code == EINTR; }

Error gone(int code) {
  return Error{"is gone: " + std::generic_category().message(code), ErrorCode::kLost};
}

}  // namespace

Client::Client(Client&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      waiting_(std::move(other.waiting_)),
      sent_(other.sent_),
      taken_(other.taken_),
      incoming_(other.incoming_) {}

Client& Client::operator=(Client&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(waiting_, other.waiting_);
  sent_ = other.sent_;
  taken_ = other.taken_;
  incoming_ = other.incoming_;
  return *this;
}

Client::~Client() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
}

void Client::add(std::span<const std::uint8_t> bytes, HostTime now) {
  if (idle()) {
    waiting_.clear();
    sent_ = 0;
    taken_ = now;
  }
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

Status Client::write(HostTime now) {
  while (!idle()) {
    const ssize_t count =
        ::send(fd_, waiting_.data() + sent_, waiting_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0) {
      return later(errno) ? Status{} : Status{gone(errno)};
    }
    sent_ += static_cast<std::size_t>(count);
    taken_ = now;
  }
  return {};
}

Status Client::read() {
  std::array<std::uint8_t, 16384> room{};
  // What a client may send while others wait for their turn.
  constexpr int kMostReads = 16;
  for (int i = 0; i < kMostReads; ++i) {
    const ssize_t count = ::recv(fd_, room.data(), room.size(), 0);
    if (count == 0) {
      return Error{"has left", ErrorCode::kLost};
    }
    if (count < 0) {
      return later(errno) ? Status{} : Status{gone(errno)};
    }
    if (Status s = incoming_.take(std::span(room).first(static_cast<std::size_t>(count))); !s) {
      return s;
    }
  }
  return {};
}

}  // namespace orthonav::igtl
