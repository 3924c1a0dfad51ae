#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/result.h"

// What comes in over OpenIGTLink is read here, and not by the library (but for the checksum): that
// loses its place in a stream of version 2.
namespace orthonav::igtl {

using Bytes = std::span<const std::uint8_t>;

inline constexpr std::size_t kHeaderBytes = 58;
/// A device's or tool's name on the wire; what is beyond is cut.
inline constexpr std::size_t kNameBytes = 20;

/// What the first bytes of a message from outside say.
struct Header {
  int version = 0;
  std::string type;
  std::string device;
  std::uint64_t timestamp = 0;  ///< seconds, 32 bits before the point and 32 after it; 0: not said
  std::uint64_t body_bytes = 0;
  std::uint64_t checksum = 0;  ///< of the body; 0 from senders that compute none
};

/// Refuses versions other than 1 to 3, and a type that is not a name: that is not OpenIGTLink.
Result<Header> parsed_header(std::span<const std::uint8_t, kHeaderBytes> bytes);

/// The checksum of a body: CRC-64 of ECMA-182, from 0, as the protocol has it.
[[nodiscard]] std::uint64_t checksum_of(Bytes body);

/// A number of up to eight bytes, the most significant first.
[[nodiscard]] std::uint64_t number_in(Bytes bytes);
/// A name in a field of fixed length: up to the first zero.
[[nodiscard]] std::string name_in(Bytes field);

/// What a message is about, cut out of its body.
struct Content {
  Bytes bytes;  ///< as in version 1
  /// What the sender says of a pose ("OK", "MISSING", ...); empty where it does not.
  std::string transform_status;
};

/// Strips what versions 2 and 3 put around the content, and reads TransformStatus, the only
/// metadata that is used. An Error where the body does not hold what it announces, or the checksum
/// differs.
Result<Content> content_of(const Header& header, Bytes body);

}  // namespace orthonav::igtl
