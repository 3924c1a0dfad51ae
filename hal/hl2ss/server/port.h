#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <vector>

#include "base/mutex.h"
#include "base/time.h"
#include "hal/hl2ss/bytes.h"
#include "hal/net/allowed.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// Bytes to be sent, and what happens after them.
struct Chunk {
  std::vector<std::uint8_t> bytes;
  Duration pause{};    ///< nothing is sent for this long afterwards
  bool close = false;  ///< the connection is closed afterwards
};

/// One port of the server: one client at a time, as on the headset. Runs on the server's network
/// thread; `send` and const functions may be called from any.
class Port {
 public:
  struct Talk {
    /// Parses the client's bytes; returns how many were consumed, 0 if more are needed. An Error
    /// ends the connection.
    std::function<Result<std::size_t>(Bytes)> understand;
    std::function<void()> came = [] {};
    std::function<void()> left = [] {};
  };
  explicit Port(Talk talk) : talk_(std::move(talk)) {}
  /// Disconnects clients that are not allowed; by default all but those of this machine.
  Status listen(const net::Endpoint& host, int port, net::Allowed allowed = {});

  [[nodiscard]] int fd() const;
  [[nodiscard]] short events() const;
  void step(short revents, HostTime now);

  /// Sends all of these chunks in this order, or none of them if too much is waiting already: a
  /// client that is too slow misses whole packets.
  void send(std::vector<Chunk> chunks);
  [[nodiscard]] bool has_client() const { return has_client_.load(); }
  /// On the network thread.
  void disconnect() ORTHONAV_EXCLUDES(mutex_);

 private:
  void read();
  void write(HostTime now) ORTHONAV_EXCLUDES(mutex_);

  Talk talk_;
  net::Socket listener_;
  net::Allowed allowed_;
  net::Socket client_;
  std::atomic<bool> has_client_ = false;
  std::vector<std::uint8_t> heard_;
  mutable Mutex mutex_;
  std::deque<Chunk> queue_ ORTHONAV_GUARDED_BY(mutex_);
  std::size_t queued_bytes_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  std::size_t sent_of_first_ ORTHONAV_GUARDED_BY(mutex_) = 0;
  HostTime silent_until_ ORTHONAV_GUARDED_BY(mutex_){};
};

}  // namespace orthonav::hl2ss
