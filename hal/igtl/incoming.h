#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/result.h"
#include "hal/igtl/message.h"

namespace orthonav::igtl {

/// What a client sends: message after message, of which the headers are read and the bodies
/// skipped. Holds no more than a header, however large a body is.
class Incoming {
 public:
  /// Takes the next bytes, cut anywhere. An Error when they are no OpenIGTLink, or a body of more
  /// than 16 MiB is announced; nothing may follow then.
  Status take(std::span<const std::uint8_t> bytes);
  /// How many headers were read.
  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  std::array<std::uint8_t, kHeaderBytes> header_{};
  std::size_t header_bytes_ = 0;
  std::uint64_t to_skip_ = 0;  ///< of the body that follows
  std::uint64_t messages_ = 0;
};

}  // namespace orthonav::igtl
