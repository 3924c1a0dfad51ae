#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "base/result.h"
#include "hal/net/socket.h"

namespace orthonav::igtl {

/// A connection to another program, made anew whenever it is lost, after a pause that doubles up
/// to two seconds. The kernel looks whether a silent one is still there. Nothing here waits.
class Link {
 public:
  Link(const net::Endpoint& host, int port) : host_(host), port_(port) {}

  /// What poll() is to watch: -1 for nothing.
  [[nodiscard]] int fd() const { return socket_.fd(); }
  [[nodiscard]] short events() const;
  /// Goes on connecting; `revents` is what poll() saw. True once: it is connected from now on.
  bool step(short revents, HostTime now);
  [[nodiscard]] bool is_connected() const { return state_ == State::kConnected; }
  /// As net::receive_some.
  Result<std::size_t> receive(std::span<std::uint8_t> room);
  void drop(const std::string& why, HostTime now);
  /// Why it is not connected, or was not the last time.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  static constexpr std::chrono::milliseconds kFirstPause{50};
  enum class State { kPausing, kConnecting, kConnected };
  void begin(HostTime now);

  net::Endpoint host_;
  int port_;
  net::Socket socket_;
  State state_ = State::kPausing;
  HostTime due_{};  ///< end of the pause, or of waiting for the connection
  std::chrono::milliseconds pause_ = kFirstPause;
  std::string trouble_;
};

}  // namespace orthonav::igtl
