#include "hal/igtl/server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <system_error>

#include "base/joined.h"
#include "hal/igtl/server_thread.h"

namespace orthonav::igtl {
namespace {

sockaddr_in address_of(const ServerOptions& options) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(options.port));
  (void)::inet_pton(AF_INET, options.address.c_str(), &address.sin_addr);
  return address;
}

/// The port at which a socket listens.
int port_of(int fd) {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  (void)::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.sin_port);
}

}  // namespace

std::vector<std::string> ServerOptions::check() const {
  std::vector<std::string> problems;
  in_addr parsed{};
  if (::inet_pton(AF_INET, address.c_str(), &parsed) != 1) {
    problems.push_back("address \"" + address + "\" must be four numbers, as in 127.0.0.1");
  }
  if (port < 0 || port > 65535) {
    problems.push_back("port " + std::to_string(port) + " must be 0 to 65535");
  }
  if (!(most_hz > 0.0) || !std::isfinite(most_hz)) {
    problems.push_back("most_hz must be greater than 0");
  }
  if (most_clients == 0) {
    problems.push_back("most_clients must be greater than 0");
  }
  return problems;
}

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{"OpenIGTLink: " + joined(problems)};
  }
  const auto failed = [&](int fd) {
    const std::string why = std::generic_category().message(errno);
    if (fd >= 0) {
      ::close(fd);
    }
    return Error{"OpenIGTLink: can't listen at " + options.address + ":" +
                     std::to_string(options.port) + ": " + why,
                 ErrorCode::kUnavailable};
  };
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  const sockaddr_in address = address_of(options);
  if (listener < 0 || ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
      ::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener, static_cast<int>(options.most_clients)) != 0) {
    return failed(listener);
  }
  const int wake_up = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (wake_up < 0) {
    return failed(listener);
  }
  return std::unique_ptr<Server>(
      new Server(std::make_unique<ServerThread>(options, listener, wake_up, port_of(listener))));
}

Server::Server(std::unique_ptr<ServerThread> thread) : thread_(std::move(thread)) {}
Server::~Server() = default;

int Server::port() const { return thread_->port(); }
void Server::publish(std::vector<std::uint8_t> frame) { thread_->publish(std::move(frame)); }
void Server::stand(std::vector<std::uint8_t> standing) { thread_->stand(std::move(standing)); }
Server::Counts Server::counts() const { return thread_->counts(); }

}  // namespace orthonav::igtl
