#include "hal/net/allowed.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>

#include <algorithm>
#include <charconv>
#include <cstring>

namespace orthonav::net {
namespace {

constexpr int kMappedBits = 96;  ///< in front of an IPv4 address mapped into IPv6
constexpr int kFewestBits = 8;

/// Absent unless the text is a whole number.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                    : std::nullopt;
}

std::array<std::uint8_t, 16> mapped(const in_addr& address) {
  std::array<std::uint8_t, 16> out{};
  out[10] = out[11] = 0xff;
  std::memcpy(&out[12], &address, sizeof address);
  return out;
}

}  // namespace

Result<Allowed::Network> Allowed::network_of(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string number = text.substr(0, slash);
  Network network;
  in_addr four{};
  int before = 0;
  if (::inet_pton(AF_INET, number.c_str(), &four) == 1) {
    network.address = mapped(four);
    before = kMappedBits;
  } else if (::inet_pton(AF_INET6, number.c_str(), network.address.data()) != 1) {
    return Error{"\"" + text + "\" is not a network, as in 192.168.1.0/24 or 10.0.0.7"};
  }
  const int most = 128 - before;
  const auto bits =
      slash == std::string::npos ? std::optional(most) : whole_number(text.substr(slash + 1));
  if (!bits || *bits < kFewestBits || *bits > most) {
    return Error{"network \"" + text + "\" must have " + std::to_string(kFewestBits) + " to " +
                 std::to_string(most) + " bits"};
  }
  network.bits = before + *bits;
  return network;
}

Result<Allowed> Allowed::of(const std::string& networks) {
  Allowed allowed;
  for (std::size_t begin = 0; begin < networks.size();) {
    const std::size_t end = std::min(networks.find(',', begin), networks.size());
    const auto network = network_of(networks.substr(begin, end - begin));
    if (!network) {
      return network.error();
    }
    allowed.networks_.push_back(*network);
    begin = end + 1;
  }
  return allowed;
}

Allowed Allowed::everybody() {
  Allowed all;
  all.networks_.push_back({});
  return all;
}

Allowed Allowed::nobody() {
  Allowed allowed;
  allowed.this_machine_ = false;
  return allowed;
}

Allowed::Address Allowed::address_of(const Endpoint& endpoint) {
  Address out{};
  if (endpoint.address.ss_family == AF_INET) {
    return mapped(reinterpret_cast<const sockaddr_in&>(endpoint.address).sin_addr);
  }
  if (endpoint.address.ss_family == AF_INET6) {
    const auto& six = reinterpret_cast<const sockaddr_in6&>(endpoint.address).sin6_addr;
    std::memcpy(out.data(), &six, out.size());
  }
  return out;
}

bool Allowed::lies_in(const Address& address, const Network& network) {
  const auto whole = static_cast<std::size_t>(network.bits / 8);
  const int rest = network.bits % 8;
  if (!std::equal(address.begin(), address.begin() + static_cast<std::ptrdiff_t>(whole),
                  network.address.begin())) {
    return false;
  }
  return rest == 0 || ((address[whole] ^ network.address[whole]) >> (8 - rest)) == 0;
}

bool Allowed::contains(const Endpoint& peer) const {
  const Address address = address_of(peer);
  return (this_machine_ && is_loopback(peer)) ||
         std::any_of(networks_.begin(), networks_.end(),
                     [&](const Network& network) { return lies_in(address, network); });
}

bool is_loopback(const Endpoint& endpoint) {
  const in_addr loopback{htonl(INADDR_LOOPBACK)};
  const Allowed::Network four{mapped(loopback), kMappedBits + 8};
  Allowed::Network six{{}, 128};
  six.address.back() = 1;
  const Allowed::Address address = Allowed::address_of(endpoint);
  return Allowed::lies_in(address, four) || Allowed::lies_in(address, six);
}

Result<Allowed> allowed_at(const std::string& host, const Endpoint& address,
                           const std::string& networks, const Token& token) {
  auto allowed =
      networks.empty() && token.is_asked_for() ? Allowed::everybody() : Allowed::of(networks);
  if (!allowed) {
    return allowed;
  }
  const Status named = check_who_may(host, address, *allowed);
  return named ? std::move(allowed) : Error{named.error().message + ", or ask for a token"};
}

Status check_who_may(const std::string& host, const Endpoint& address, const Allowed& allowed) {
  if (is_loopback(address) || allowed.names_others()) {
    return {};
  }
  return Error{"other machines reach " + host + "; name who may connect, as in 192.168.1.0/24"};
}

std::string text_of(const Endpoint& endpoint) {
  std::array<char, NI_MAXHOST> text{};
  const int failed =
      ::getnameinfo(reinterpret_cast<const sockaddr*>(&endpoint.address), endpoint.length,
                    text.data(), text.size(), nullptr, 0, NI_NUMERICHOST);
  return failed == 0 ? std::string(text.data()) : "?";
}

Endpoint peer_of(const Socket& socket) {
  Endpoint peer;
  peer.length = sizeof(peer.address);
  if (::getpeername(socket.fd(), reinterpret_cast<sockaddr*>(&peer.address), &peer.length) != 0) {
    return {};
  }
  return peer;
}

}  // namespace orthonav::net
