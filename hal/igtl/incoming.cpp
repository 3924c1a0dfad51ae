#include "hal/igtl/incoming.h"

#include <algorithm>
#include <string>

namespace orthonav::igtl {
namespace {

constexpr std::uint64_t kLargestBody = 16u << 20u;

}  // namespace

Status Incoming::take(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    if (to_skip_ > 0) {
      const std::uint64_t skipped = std::min<std::uint64_t>(to_skip_, bytes.size());
      to_skip_ -= skipped;
      bytes = bytes.subspan(static_cast<std::size_t>(skipped));
      continue;
    }
    const std::size_t part = std::min(kHeaderBytes - header_bytes_, bytes.size());
    std::copy_n(bytes.begin(), part, header_.begin() + static_cast<std::ptrdiff_t>(header_bytes_));
    header_bytes_ += part;
    bytes = bytes.subspan(part);
    if (header_bytes_ < kHeaderBytes) {
      continue;
    }
    header_bytes_ = 0;
    const auto header = parsed_header(std::span<const std::uint8_t, kHeaderBytes>(header_));
    if (!header) {
      return header.error();
    }
    if (header->body_bytes > kLargestBody) {
      return Error{"announces " + header->type + " of " + std::to_string(header->body_bytes) +
                   " bytes, limit " + std::to_string(kLargestBody)};
    }
    to_skip_ = header->body_bytes;
    ++messages_;
  }
  return {};
}

}  // namespace orthonav::igtl
