#include "hal/net/socket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>

namespace orthonav::net {
namespace {

using std::chrono::milliseconds;

constexpr auto kTryAgain = milliseconds(50);
/// If connections are refused for this long, the port is considered closed.
constexpr auto kRefusedFor = std::chrono::seconds(1);

std::string reason(int code) { return std::generic_category().message(code); }

void set_port(Endpoint& host, int port) {
  const auto network_port = htons(static_cast<std::uint16_t>(port));
  if (host.address.ss_family == AF_INET6) {
    reinterpret_cast<sockaddr_in6&>(host.address).sin6_port = network_port;
  } else {
    reinterpret_cast<sockaddr_in&>(host.address).sin_port = network_port;
  }
}

Result<Socket> open_socket(const Endpoint& host) {
  Socket socket(
      ::socket(host.address.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, IPPROTO_TCP));
  if (!socket.is_open()) {
    return Error{"no socket: " + reason(errno), ErrorCode::kUnavailable};
  }
  // Small requests must not be delayed (Nagle's algorithm).
  const int on = 1;
  (void)::setsockopt(socket.fd(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  return socket;
}

/// Waits for `events`; false once the deadline has passed.
bool wait_for(const Socket& socket, short events, HostTime deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(deadline - HostClock::now()).count();
    if (left <= 0) {
      return false;
    }
    pollfd one{socket.fd(), events, 0};
    const int answer = ::poll(&one, 1, static_cast<int>(std::min<std::int64_t>(left, 1000)));
    if (answer > 0) {
      return true;
    }
    if (answer < 0 && errno != EINTR) {
      return false;
    }
  }
}

Status send_all(const Socket& socket, Bytes bytes, HostTime deadline) {
  while (!bytes.empty()) {
    const auto sent = send_some(socket, bytes);
    if (!sent) {
      return sent.error();
    }
    bytes = bytes.subspan(*sent);
    if (!bytes.empty() && !wait_for(socket, POLLOUT, deadline)) {
      return Error{"no time left", ErrorCode::kUnavailable};
    }
  }
  return {};
}

Result<std::vector<std::uint8_t>> ask_once(const Endpoint& host, int port, Bytes request,
                                           std::size_t answer_bytes, HostTime deadline,
                                           bool& connected) {
  const auto socket = begin_connect(host, port);
  if (!socket) {
    return socket.error();
  }
  if (!wait_for(*socket, POLLOUT, deadline)) {
    return Error{"does not answer", ErrorCode::kUnavailable};
  }
  if (const Status outcome = connect_outcome(*socket); !outcome) {
    return outcome.error();
  }
  connected = true;
  if (const Status sent = send_all(*socket, request, deadline); !sent) {
    return sent.error();
  }
  std::vector<std::uint8_t> answer(answer_bytes);
  std::size_t have = 0;
  while (have < answer_bytes) {
    const auto got = receive_some(*socket, std::span(answer).subspan(have));
    if (!got) {
      return Error{got.error().message + " after " + std::to_string(have) + " of " +
                       std::to_string(answer_bytes) + " bytes",
                   got.error().code};
    }
    have += *got;
    if (*got == 0 && !wait_for(*socket, POLLIN, deadline)) {
      return Error{
          "sent " + std::to_string(have) + " of " + std::to_string(answer_bytes) + " bytes in time",
          ErrorCode::kUnavailable};
    }
  }
  return answer;
}

}  // namespace

void wait_for_news(std::span<pollfd> watched, int timeout_ms) {
  if (::poll(watched.data(), watched.size(), timeout_ms) >= 0) {
    return;
  }
  const bool interrupted = errno == EINTR;
  for (pollfd& each : watched) {
    each.revents = 0;
  }
  if (!interrupted) {
    std::this_thread::sleep_for(milliseconds(timeout_ms));
  }
}

Socket::~Socket() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
}

Result<Endpoint> resolve(const std::string& host) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int code = ::getaddrinfo(host.c_str(), nullptr, &hints, &found);
  if (code != 0) {
    return Error{"unknown host \"" + host + "\": " + std::string(::gai_strerror(code)),
                 code == EAI_AGAIN ? ErrorCode::kUnavailable : ErrorCode::kNotFound};
  }
  Endpoint endpoint;
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    // Headsets listen at IPv4.
    if (endpoint.length != 0 && each->ai_family != AF_INET) {
      continue;
    }
    if (endpoint.length != 0 && endpoint.address.ss_family == AF_INET) {
      continue;
    }
    std::memcpy(&endpoint.address, each->ai_addr, each->ai_addrlen);
    endpoint.length = each->ai_addrlen;
  }
  ::freeaddrinfo(found);
  if (endpoint.length == 0) {
    return Error{"host \"" + host + "\" has no address", ErrorCode::kNotFound};
  }
  return endpoint;
}

Result<Socket> begin_connect(Endpoint host, int port) {
  set_port(host, port);
  auto socket = open_socket(host);
  if (!socket) {
    return socket;
  }
  const auto* address = reinterpret_cast<const sockaddr*>(&host.address);
  if (::connect(socket->fd(), address, host.length) != 0 && errno != EINPROGRESS) {
    return Error{reason(errno), ErrorCode::kUnavailable};
  }
  return socket;
}

Status connect_outcome(const Socket& socket) {
  int code = 0;
  socklen_t length = sizeof(code);
  if (::getsockopt(socket.fd(), SOL_SOCKET, SO_ERROR, &code, &length) != 0) {
    code = errno;
  }
  if (code != 0) {
    return Error{reason(code), ErrorCode::kUnavailable};
  }
  return {};
}

Result<Socket> listen_at(Endpoint host, int port, int waiting) {
  set_port(host, port);
  auto socket = open_socket(host);
  if (!socket) {
    return socket;
  }
  const int on = 1;
  (void)::setsockopt(socket->fd(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  const auto* address = reinterpret_cast<const sockaddr*>(&host.address);
  if (::bind(socket->fd(), address, host.length) != 0 || ::listen(socket->fd(), waiting) != 0) {
    return Error{"port " + std::to_string(port) + ": " + reason(errno), ErrorCode::kUnavailable};
  }
  return socket;
}

int port_of(const Socket& listener) {
  sockaddr_storage address{};
  socklen_t length = sizeof(address);
  (void)::getsockname(listener.fd(), reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(address).sin6_port
                                             : reinterpret_cast<sockaddr_in&>(address).sin_port);
}

std::optional<Socket> accept_one(const Socket& listener) {
  const int fd = ::accept4(listener.fd(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd < 0) {
    return std::nullopt;
  }
  const int on = 1;
  (void)::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  return Socket(fd);
}

Result<std::size_t> receive_some(const Socket& socket, std::span<std::uint8_t> room) {
  if (room.empty()) {
    return std::size_t{0};
  }
  const auto count = ::recv(socket.fd(), room.data(), room.size(), 0);
  if (count > 0) {
    return static_cast<std::size_t>(count);
  }
  if (count == 0) {
    return Error{"closed by the other side", ErrorCode::kLost};
  }
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) {
    return std::size_t{0};
  }
  return Error{reason(errno), ErrorCode::kLost};
}

Result<std::size_t> send_some(const Socket& socket, Bytes bytes) {
  if (bytes.empty()) {
    return std::size_t{0};
  }
  const auto count = ::send(socket.fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (count >= 0) {
    return static_cast<std::size_t>(count);
  }
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) {
    return std::size_t{0};
  }
  return Error{reason(errno), ErrorCode::kLost};
}

void cut_off(const Socket& socket) {
  const linger at_once{1, 0};
  (void)::setsockopt(socket.fd(), SOL_SOCKET, SO_LINGER, &at_once, sizeof(at_once));
}

void finish_sending(const Socket& socket, HostTime deadline) {
  (void)::shutdown(socket.fd(), SHUT_WR);
  std::array<std::uint8_t, 4096> rest{};
  while (receive_some(socket, rest) && wait_for(socket, POLLIN, deadline)) {
  }
}

Status reach(const Endpoint& host, int port, HostTime deadline) {
  const auto socket = begin_connect(host, port);
  if (!socket) {
    return socket.error();
  }
  if (!wait_for(*socket, POLLOUT, deadline)) {
    return Error{"does not answer", ErrorCode::kUnavailable};
  }
  return connect_outcome(*socket);
}

Result<std::vector<std::uint8_t>> ask(const Endpoint& host, int port, Bytes request,
                                      std::size_t answer_bytes, HostTime deadline) {
  bool connected = false;
  const HostTime refused_by = HostClock::now() + kRefusedFor;
  for (;;) {
    auto answer = ask_once(host, port, request, answer_bytes, deadline, connected);
    const HostTime last = connected ? deadline : std::min(deadline, refused_by);
    if (answer || HostClock::now() + kTryAgain >= last) {
      if (answer) {
        return answer;
      }
      return Error{"port " + std::to_string(port) + ": " + answer.error().message,
                   answer.error().code};
    }
    std::this_thread::sleep_for(kTryAgain);
  }
}

WakeUp::WakeUp() : event_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

void WakeUp::wake() const {
  const std::uint64_t one = 1;
  (void)!::write(event_.fd(), &one, sizeof(one));
}

void WakeUp::clear() const {
  std::uint64_t count = 0;
  (void)!::read(event_.fd(), &count, sizeof(count));
}

}  // namespace orthonav::net
