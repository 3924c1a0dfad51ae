#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/result.h"

// Incoming OpenIGTLink messages are parsed here, not by the library (except for the checksum),
// which loses its place in a stream of version 2.
namespace orthonav::igtl {

using Bytes = std::span<const std::uint8_t>;

inline constexpr std::size_t kHeaderBytes = 58;
/// Length of a device's or tool's name on the wire; longer names are cut.
inline constexpr std::size_t kNameBytes = 20;

/// The header of an incoming message.
struct Header {
  int version = 0;
  std::string type;
  std::string device;
  std::uint64_t timestamp = 0;  ///< seconds, 32 bits before the point and 32 after it; 0: not
                                ///< stated
  std::uint64_t body_bytes = 0;
  std::uint64_t checksum = 0;  ///< of the body; 0 from senders without checksums
};

/// Refuses versions other than 1 to 3, and a type that is not a name: that is not OpenIGTLink.
Result<Header> parsed_header(std::span<const std::uint8_t, kHeaderBytes> bytes);

/// The checksum of a body: CRC-64 of ECMA-182, from 0, as the protocol defines it.
[[nodiscard]] std::uint64_t checksum_of(Bytes body);

/// A number of up to eight bytes, the most significant first.
[[nodiscard]] std::uint64_t number_in(Bytes bytes);
/// A name in a field of fixed length: up to the first zero.
[[nodiscard]] std::string name_in(Bytes field);

/// The content of a message, extracted from its body.
struct Content {
  Bytes bytes;  ///< as in version 1
  /// The sender's status of a pose ("OK", "MISSING", ...); empty if not stated.
  std::string transform_status;
};

/// Strips the data that versions 2 and 3 put around the content, and reads TransformStatus, the
/// only metadata used. An Error if the body does not hold what it announces, or if the checksum
/// differs.
Result<Content> content_of(const Header& header, Bytes body);

}  // namespace orthonav::igtl
