#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/net/socket.h"
#include "hal/net/token.h"

namespace orthonav::net {

/// Who may connect to a port whose protocol has no passwords: this machine and the given networks.
/// Addresses can be forged: this keeps out strangers, not attackers.
class Allowed {
 public:
  /// Only this machine.
  Allowed() = default;
  /// From "192.168.1.0/24,10.0.0.7"; empty: only this machine. An Error names an entry that is not
  /// a network, or has fewer than 8 bits and would let in nearly everyone.
  static Result<Allowed> of(const std::string& networks);

  /// Not even this machine.
  static Allowed nobody();
  /// All networks: for a port that asks for a token.
  static Allowed everybody();

  [[nodiscard]] bool names_others() const { return !networks_.empty(); }
  [[nodiscard]] bool contains(const Endpoint& peer) const;

 private:
  /// An IPv6 address, or an IPv4 address mapped into IPv6.
  using Address = std::array<std::uint8_t, 16>;
  struct Network {
    Address address{};
    int bits = 0;
  };
  static Result<Network> network_of(const std::string& text);
  static bool lies_in(const Address& address, const Network& network);
  static Address address_of(const Endpoint& endpoint);
  friend bool is_loopback(const Endpoint& endpoint);

  bool this_machine_ = true;
  std::vector<Network> networks_;
};

[[nodiscard]] bool is_loopback(const Endpoint& endpoint);
/// Who may connect to a port at this address: those of `networks`, as for Allowed::of; everybody if
/// none are named and a token is asked for. An Error if other machines can reach the port and
/// neither is so.
[[nodiscard]] Result<Allowed> allowed_at(const std::string& host, const Endpoint& address,
                                         const std::string& networks, const Token& token);
/// Refuses a port that other machines can reach if none of them is allowed.
[[nodiscard]] Status check_who_may(const std::string& host, const Endpoint& address,
                                   const Allowed& allowed);
/// Numeric: "192.168.1.20"; "?" if it is not an IP address.
[[nodiscard]] std::string text_of(const Endpoint& endpoint);
/// The other side of a connection; without an address family if it is already gone.
[[nodiscard]] Endpoint peer_of(const Socket& socket);

}  // namespace orthonav::net
