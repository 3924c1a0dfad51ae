#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/hl2ss/arrival_meter.h"
#include "hal/net/link.h"

namespace orthonav::hl2ss {

/// Interprets the bytes of one port. All calls come from the thread that runs the links.
class Protocol {
 public:
  virtual ~Protocol() = default;
  /// The bytes sent first on each new connection.
  [[nodiscard]] virtual std::vector<std::uint8_t> opening() = 0;
  /// Room for bytes, then how many arrived at this time. An Error ends the connection, since the
  /// rest can't be understood.
  virtual std::span<std::uint8_t> room() = 0;
  virtual Status received(std::size_t count, HostTime at) = 0;
  /// The bytes to send now, if any; called regularly.
  [[nodiscard]] virtual std::vector<std::uint8_t> more(HostTime /*now*/) { return {}; }
  /// An Error means that data sent but not yet delivered must not arrive any more: the connection
  /// is reset.
  [[nodiscard]] virtual Status overdue(HostTime /*now*/) { return {}; }
  /// The bytes sent last before disconnecting.
  [[nodiscard]] virtual std::vector<std::uint8_t> goodbye() { return {}; }
  virtual void disconnected() = 0;
};

/// One port of the headset: a link with a protocol, which drops a connection that is silent for too
/// long. Nothing here waits.
class Connection {
 public:
  struct Options {
    int port = 0;
    Duration longest_silence = std::chrono::seconds(3);
  };
  /// Meter and protocol are borrowed; both are told of everything that happens here.
  Connection(const net::Endpoint& host, Options options, ArrivalMeter& meter, Protocol& protocol)
      : options_(options), meter_(meter), protocol_(protocol), link_(host, options.port) {}

  /// The descriptor that poll() should watch; -1 for none.
  [[nodiscard]] int fd() const { return link_.fd(); }
  [[nodiscard]] short events() const;
  /// Does what is due; `revents` comes from poll().
  void step(short revents, HostTime now);
  /// Sends the goodbye, if the protocol has one; waits at most 0.1 s for it to arrive.
  void leave();
  [[nodiscard]] bool is_connected() const { return link_.is_connected(); }
  [[nodiscard]] Duration round_trip() const {
    return std::chrono::duration_cast<Duration>(link_.round_trip());
  }

 private:
  void connected(HostTime now);
  void read(HostTime now);
  void write();
  void say_more(HostTime now);
  void drop(const std::string& why, HostTime now);
  void tell_trouble();

  Options options_;
  ArrivalMeter& meter_;
  Protocol& protocol_;
  net::Link link_;
  HostTime heard_{};
  std::vector<std::uint8_t> unsent_;
};

}  // namespace orthonav::hl2ss
