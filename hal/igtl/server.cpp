#include "hal/igtl/server.h"

#include <arpa/inet.h>

#include <cmath>

#include "base/joined.h"
#include "hal/igtl/server_thread.h"
#include "hal/net/allowed.h"
#include "hal/net/host_port.h"

namespace orthonav::igtl {
std::vector<std::string> ServerOptions::check() const {
  std::vector<std::string> problems;
  in6_addr parsed{};
  if (::inet_pton(AF_INET, address.c_str(), &parsed) != 1 &&
      ::inet_pton(AF_INET6, address.c_str(), &parsed) != 1) {
    problems.push_back("address \"" + address + "\" must be numbers, as in 127.0.0.1 or [::1]");
  }
  if (port < 0 || port > net::kMaxPort) {
    problems.push_back("port " + std::to_string(port) + " must be 0 to 65535");
  }
  if (!(most_hz > 0.0) || !std::isfinite(most_hz)) {
    problems.push_back("most_hz must be greater than 0");
  }
  if (most_clients == 0) {
    problems.push_back("most_clients must be greater than 0");
  }
  if (most_calls < 1) {
    problems.push_back("most_calls must be greater than 0");
  }
  if (const auto allowed = net::Allowed::of(allow); !allowed) {
    problems.push_back("allow: " + allowed.error().message);
  }
  return problems;
}

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options,
                                              TextListener* listener) {
  if (const auto problems = options.check(); !problems.empty()) {
    return Error{"OpenIGTLink: " + joined(problems)};
  }
  const auto host = net::resolve(options.address);
  if (!host) {
    return host.error();
  }
  const auto allowed = net::allowed_at(options.address, *host, options.allow, options.token);
  if (!allowed) {
    return Error{"OpenIGTLink: " + allowed.error().message};
  }
  auto socket = net::listen_at(*host, options.port, static_cast<int>(options.most_clients));
  if (!socket) {
    return Error{"OpenIGTLink: can't listen at " + options.address + ": " + socket.error().message,
                 ErrorCode::kUnavailable};
  }
  return std::unique_ptr<Server>(
      new Server(std::make_unique<ServerThread>(options, *allowed, std::move(*socket), listener)));
}

Server::Server(std::unique_ptr<ServerThread> thread) : thread_(std::move(thread)) {}
Server::~Server() = default;

int Server::port() const { return thread_->port(); }
void Server::publish(std::vector<std::uint8_t> frame) { thread_->publish(std::move(frame)); }
void Server::set_standing(std::vector<std::uint8_t> standing) {
  thread_->set_standing(std::move(standing));
}
void Server::tell(std::vector<std::uint8_t> bytes) { thread_->tell(bytes); }
Server::Counts Server::counts() const { return thread_->counts(); }

}  // namespace orthonav::igtl
