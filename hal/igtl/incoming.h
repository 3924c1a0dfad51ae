#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "hal/igtl/header.h"

namespace orthonav::igtl {

/// Who wants to know what some messages say.
class MessageReader {
 public:
  virtual ~MessageReader() = default;
  /// Whether the body that this header announces is wanted; the others are skipped.
  [[nodiscard]] virtual bool wants(const Header& header) const = 0;
  /// A whole message that was wanted. An Error ends the stream: nothing may follow.
  virtual Status read(const Header& header, Bytes body) = 0;
};

/// What the other side sends: message after message, of which the headers are read and the bodies
/// skipped, or kept until they are whole where somebody wants them.
class Incoming {
 public:
  /// A body that is wanted and larger than this is skipped all the same.
  static constexpr std::uint64_t kLargestKept = 128u << 10u;

  /// `reader` is borrowed; null: nobody wants anything, and no more than a header is ever held.
  explicit Incoming(MessageReader* reader = nullptr) : reader_(reader) {}

  /// Takes the next bytes, cut anywhere. An Error when they are no OpenIGTLink, or a body of more
  /// than 16 MiB is announced; nothing may follow then.
  Status take(std::span<const std::uint8_t> bytes);
  /// How many headers were read.
  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  Status begin_body();
  Status end_body();
  /// Takes up to `most` bytes off the front of `bytes`.
  static Bytes cut_off(Bytes& bytes, std::uint64_t most);

  MessageReader* reader_;
  std::array<std::uint8_t, kHeaderBytes> header_bytes_{};
  std::size_t header_has_ = 0;
  Header header_;
  std::uint64_t to_come_ = 0;  ///< of the body
  bool keeps_ = false;
  std::vector<std::uint8_t> body_;
  std::uint64_t messages_ = 0;
};

}  // namespace orthonav::igtl
