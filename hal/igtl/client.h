#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "hal/igtl/incoming.h"

namespace orthonav::igtl {

using HostTime = std::chrono::steady_clock::time_point;

/// One connected client: what it sends is skipped, what it is to get waits until it takes it.
class Client {
 public:
  /// Takes the descriptor, which does not block.
  Client(int fd, HostTime now) : fd_(fd), taken_(now) {}
  Client(Client&& other) noexcept;
  Client& operator=(Client&& other) noexcept;
  ~Client();

  [[nodiscard]] int fd() const { return fd_; }
  /// Everything that it was given has gone.
  [[nodiscard]] bool idle() const { return sent_ == waiting_.size(); }
  /// Since when it has taken nothing of what waits.
  [[nodiscard]] HostTime taken() const { return taken_; }

  /// Appends what it must get.
  void add(std::span<const std::uint8_t> bytes, HostTime now);
  /// Sends what it takes now. An Error when it is gone.
  Status write(HostTime now);
  /// Reads what there is. An Error when it is gone, or sends what is no OpenIGTLink.
  Status read();

 private:
  int fd_ = -1;
  std::vector<std::uint8_t> waiting_;
  std::size_t sent_ = 0;
  HostTime taken_;
  Incoming incoming_;
};

}  // namespace orthonav::igtl
