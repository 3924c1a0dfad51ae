#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "base/result.h"
#include "hal/net/socket.h"

namespace orthonav::net {

/// A connection to a port of another machine, made again whenever it is lost, after a pause that
/// doubles up to two seconds until bytes arrive. Nothing here waits.
class Link {
 public:
  /// The result of a step. kFailed: connecting failed, `trouble` says why.
  enum class Step : std::uint8_t { kNothing, kConnected, kFailed };

  Link(const Endpoint& host, int port) : host_(host), port_(port) {}

  /// The descriptor that poll() should watch; -1 for none.
  [[nodiscard]] int fd() const { return socket_.fd(); }
  [[nodiscard]] short events() const;
  /// Continues connecting; `revents` comes from poll().
  Step step(short revents, HostTime now);
  [[nodiscard]] bool is_connected() const { return state_ == State::kConnected; }
  [[nodiscard]] const Socket& socket() const { return socket_; }
  /// How long the other side took to accept the connection.
  [[nodiscard]] HostClock::duration round_trip() const { return round_trip_; }
  /// As receive_some.
  Result<std::size_t> receive(std::span<std::uint8_t> room);
  void drop(const std::string& why, HostTime now);
  /// Why it is not connected, or why the last attempt failed.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  static constexpr std::chrono::milliseconds kFirstPause{50};
  enum class State : std::uint8_t { kPausing, kConnecting, kConnected };
  Status begin(HostTime now);

  Endpoint host_;
  int port_;
  Socket socket_;
  State state_ = State::kPausing;
  HostTime due_{};  ///< end of the pause, or of waiting for the connection
  HostTime begun_{};
  HostClock::duration round_trip_{};
  std::chrono::milliseconds pause_ = kFirstPause;
  std::string trouble_;
};

/// Makes the kernel probe a silent peer, so that a dead one is detected within ten seconds.
void keep_alive(const Socket& socket);

}  // namespace orthonav::net
