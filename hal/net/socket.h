#pragma once

#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace orthonav {

/// This machine's own time, for deadlines and for comparison with a headset's clock; the two are
/// never mixed.
using HostClock = std::chrono::steady_clock;
using HostTime = HostClock::time_point;

}  // namespace orthonav

// TCP that never blocks, for devices at the end of a network.
namespace orthonav::net {

using Bytes = std::span<const std::uint8_t>;

/// A file descriptor, closed on destruction.
class Socket {
 public:
  Socket() = default;
  explicit Socket(int fd) : fd_(fd) {}
  Socket(Socket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket();
  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

/// A host's address; the port is given with each connection.
struct Endpoint {
  sockaddr_storage address{};
  socklen_t length = 0;
};
/// By name or numeric address; a name lookup may block.
Result<Endpoint> resolve(const std::string& host);

/// poll(), for at most this long. Where the system refuses it (too many files, no memory), nothing
/// is new, and the call lasts as long, so that whoever asks again does not spin.
void wait_for_news(std::span<pollfd> watched, int timeout_ms);

/// Starts connecting without waiting.
Result<Socket> begin_connect(Endpoint host, int port);
/// The result of a started connection, once its socket is writable.
Status connect_outcome(const Socket& socket);
/// Listens at a port of `host`; `waiting` clients may queue to be accepted. Port 0: any free one.
Result<Socket> listen_at(Endpoint host, int port, int waiting = 4);
/// The port at which a socket listens.
int port_of(const Socket& listener);
/// The waiting client, if there is one.
std::optional<Socket> accept_one(const Socket& listener);

/// How many bytes came at once; 0: none now. `ErrorCode::kLost` when the other side
/// closed or reset.
Result<std::size_t> receive_some(const Socket& socket, std::span<std::uint8_t> room);
/// How many bytes went at once; fails as `receive_some` does.
Result<std::size_t> send_some(const Socket& socket, Bytes bytes);

/// Makes closing the socket discard undelivered data; the other side sees a reset.
void cut_off(const Socket& socket);
/// Shuts down our side and waits until the other has read everything and closed, or until the
/// deadline.
void finish_sending(const Socket& socket, HostTime deadline);

/// Connects and closes again. Blocks until `deadline` at most.
Status reach(const Endpoint& host, int port, HostTime deadline);
/// Connects, sends `request` and waits for `answer_bytes` bytes; retries while another client is
/// still leaving the port. Blocks until `deadline` at most.
Result<std::vector<std::uint8_t>> ask(const Endpoint& host, int port, Bytes request,
                                      std::size_t answer_bytes, HostTime deadline);

/// Wakes a thread that waits in poll().
class WakeUp {
 public:
  WakeUp();
  void wake() const;
  /// Call this once woken.
  void clear() const;
  [[nodiscard]] int fd() const { return event_.fd(); }

 private:
  Socket event_;
};

}  // namespace orthonav::net
