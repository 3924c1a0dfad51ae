#pragma once

#include <cstddef>

#include "hal/net/socket.h"

namespace orthonav::net {

/// Limits an amount per second. A second begins with the first item after the previous second
/// ended.
class RateLimit {
 public:
  /// Adds `amount`; returns whether the sum is still within `most`.
  [[nodiscard]] bool allows(std::size_t amount, std::size_t most, HostTime now) {
    if (now - since_ >= std::chrono::seconds(1)) {
      since_ = now;
      counted_ = 0;
    }
    counted_ += amount;
    return counted_ <= most;
  }

 private:
  HostTime since_{};
  std::size_t counted_ = 0;
};

}  // namespace orthonav::net
