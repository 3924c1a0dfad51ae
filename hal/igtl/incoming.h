#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "hal/igtl/header.h"

namespace orthonav::igtl {

/// Receives the messages that it wants.
class MessageReader {
 public:
  virtual ~MessageReader() = default;
  /// Whether the body that this header announces is wanted; the others are skipped.
  [[nodiscard]] virtual bool wants(const Header& header) const = 0;
  /// Takes a complete wanted message. An Error ends the stream.
  virtual Status read(const Header& header, Bytes body) = 0;
};

/// The incoming stream of messages: headers are read, and bodies are skipped, or kept until
/// complete if the reader wants them.
class Incoming {
 public:
  /// A wanted body larger than this is skipped anyway.
  static constexpr std::uint64_t kLargestKept = 128u << 10u;

  /// `reader` is borrowed; null: all bodies are skipped, and no more than a header is ever held.
  explicit Incoming(MessageReader* reader = nullptr) : reader_(reader) {}

  /// Takes the next bytes, split anywhere. An Error if they are not OpenIGTLink, or if a body of
  /// more than 16 MiB is announced; no more bytes may be passed after that.
  Status take(std::span<const std::uint8_t> bytes);
  /// Number of headers read.
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
