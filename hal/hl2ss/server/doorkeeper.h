#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hal/hl2ss/server/port.h"
#include "hal/net/token.h"

namespace orthonav::hl2ss {

/// Takes the token at the server's door (hal/hl2ss/door.h). Runs on the network thread.
class Doorkeeper {
 public:
  explicit Doorkeeper(net::Token token) : token_(std::move(token)) {}
  [[nodiscard]] bool asks() const { return token_.is_asked_for(); }
  [[nodiscard]] Port& port() { return port_; }
  /// Hangs up on whoever has not brought the token within 5 s.
  void step(HostTime now);
  /// Whether a client at this address may use the other ports: for a minute after it has brought
  /// the token, and after each call that said so.
  bool admits(const net::Endpoint& peer, HostTime now);

 private:
  struct Guest {
    std::string address;
    HostTime until;
  };
  Result<std::size_t> understand(Bytes said);

  net::Token token_;
  HostTime came_{};
  std::vector<Guest> guests_;
  Port port_{
      {[this](Bytes said) { return understand(said); }, [this] { came_ = HostClock::now(); }}};
};

}  // namespace orthonav::hl2ss
