#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "hal/igtl/incoming.h"
#include "hal/net/socket.h"

namespace orthonav::igtl {

/// One connected client: what it sends is skipped; what it is sent waits until it takes it.
class Client {
 public:
  Client(net::Socket socket, HostTime now) : socket_(std::move(socket)), taken_(now) {}

  [[nodiscard]] int fd() const { return socket_.fd(); }
  /// Nothing waits to be taken.
  [[nodiscard]] bool idle() const { return sent_ == waiting_.size(); }
  /// When it last took something, or was last idle.
  [[nodiscard]] HostTime taken() const { return taken_; }

  /// Puts these bytes behind what waits.
  void add(std::span<const std::uint8_t> bytes, HostTime now);
  /// Sends what it takes now. An Error when it is gone.
  Status write(HostTime now);
  /// Reads what there is. An Error when it is gone (`ErrorCode::kLost` when it closed), or sends
  /// what is no OpenIGTLink, or more than so many bytes within a second.
  Status read(HostTime now, std::size_t most_bytes_per_s);

 private:
  net::Socket socket_;
  std::vector<std::uint8_t> waiting_;
  std::size_t sent_ = 0;
  HostTime taken_;
  Incoming incoming_;
  HostTime counted_since_{};
  std::size_t counted_ = 0;  ///< bytes that came since then
};

}  // namespace orthonav::igtl
