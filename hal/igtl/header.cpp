#include "hal/igtl/header.h"

#include <algorithm>

namespace orthonav::igtl {
namespace {

/// In front of the content since version 2: its own length, those of the metadata's two parts, and
/// a number.
constexpr std::size_t kExtendedHeaderBytes = 12;
constexpr std::size_t kEntryBytes = 8;  ///< of the metadata's index: key, encoding, value
constexpr const char* kStatusKey = "TransformStatus";

std::uint16_t u16(Bytes bytes, std::size_t at) {
  return static_cast<std::uint16_t>(number_in(bytes.subspan(at, 2)));
}

std::string text_in(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

/// An index (the count; then each entry's key length, encoding and value length), followed by keys
/// and values. Empty if it is missing or the index is invalid.
std::string transform_status_in(Bytes index, Bytes text) {
  if (index.size() < 2) {
    return {};
  }
  const std::size_t entries =
      std::min<std::size_t>(u16(index, 0), (index.size() - 2) / kEntryBytes);
  for (std::size_t i = 0; i < entries; ++i) {
    const Bytes entry = index.subspan(2 + i * kEntryBytes, kEntryBytes);
    const std::uint64_t key_bytes = u16(entry, 0);
    const std::uint64_t value_bytes = number_in(entry.subspan(4, 4));
    if (key_bytes + value_bytes > text.size()) {
      return {};
    }
    const auto key_size = static_cast<std::size_t>(key_bytes);
    const auto value_size = static_cast<std::size_t>(value_bytes);
    if (text_in(text.first(key_size)) == kStatusKey) {
      return text_in(text.subspan(key_size, value_size));
    }
    text = text.subspan(key_size + value_size);
  }
  return {};
}

}  // namespace

std::uint64_t number_in(Bytes bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) {
    value = value << 8u | byte;
  }
  return value;
}

std::string name_in(Bytes field) {
  const auto end = std::find(field.begin(), field.end(), 0);
  return {field.begin(), end};
}

Result<Header> parsed_header(std::span<const std::uint8_t, kHeaderBytes> bytes) {
  // Version (2 bytes), type (12), device (20), time (8), length of the body (8), checksum (8).
  constexpr int kNewest = 3;
  Header header;
  header.version = static_cast<int>(number_in(bytes.first(2)));
  header.type = name_in(bytes.subspan(2, 12));
  header.device = name_in(bytes.subspan(14, 20));
  header.timestamp = number_in(bytes.subspan(34, 8));
  header.body_bytes = number_in(bytes.subspan(42, 8));
  header.checksum = number_in(bytes.subspan(50, 8));
  const bool named = !header.type.empty() &&
                     std::all_of(header.type.begin(), header.type.end(), [](unsigned char c) {
                       return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
                     });
  if (header.version < 1 || header.version > kNewest || !named) {
    return Error{"sends what is not an OpenIGTLink message"};
  }
  return header;
}

Result<Content> content_of(const Header& header, Bytes body) {
  if (header.checksum != 0 && header.checksum != checksum_of(body)) {
    return Error{header.type + " " + header.device + ": the checksum is not that of its body"};
  }
  if (header.version < 2) {
    return Content{body, {}};
  }
  const std::string what = header.type + " " + header.device + ": ";
  if (body.size() < kExtendedHeaderBytes) {
    return Error{what + std::to_string(body.size()) + " bytes, at least " +
                 std::to_string(kExtendedHeaderBytes) + " needed"};
  }
  const std::uint64_t before = u16(body, 0);
  const std::uint64_t index = u16(body, 2);
  const std::uint64_t text = number_in(body.subspan(4, 4));
  if (before < kExtendedHeaderBytes || before + index + text > body.size()) {
    return Error{what + "the parts that it announces are not within its " +
                 std::to_string(body.size()) + " bytes"};
  }
  const auto metadata = static_cast<std::size_t>(index + text);
  const std::size_t end = body.size() - metadata;
  const Bytes all_metadata = body.subspan(end);
  const auto index_size = static_cast<std::size_t>(index);
  return Content{
      body.subspan(static_cast<std::size_t>(before), end - static_cast<std::size_t>(before)),
      transform_status_in(all_metadata.first(index_size), all_metadata.subspan(index_size))};
}

}  // namespace orthonav::igtl
