#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/net/socket.h"

namespace orthonav::net {

/// Who may connect to a port that speaks a protocol without passwords: this machine, and the
/// networks named. An address is no proof of who somebody is; it keeps strangers out, not forgers.
class Allowed {
 public:
  /// This machine alone.
  Allowed() = default;
  /// Of "192.168.1.0/24,10.0.0.7"; empty: this machine alone. An Error names what is no network,
  /// and one of fewer than 8 bits, which would be everybody.
  static Result<Allowed> of(const std::string& networks);

  /// Not even this machine.
  static Allowed nobody();

  [[nodiscard]] bool names_others() const { return !networks_.empty(); }
  [[nodiscard]] bool contains(const Endpoint& peer) const;

 private:
  /// As IPv6 has it; IPv4 mapped into it.
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
/// A port that other machines can reach must say which of them may.
[[nodiscard]] Status check_who_may(const std::string& host, const Endpoint& address,
                                   const Allowed& allowed);
/// The other side of a connection; its address as it is written, without the port.
[[nodiscard]] Endpoint peer_of(const Socket& socket);
[[nodiscard]] std::string text_of(const Endpoint& endpoint);

}  // namespace orthonav::net
