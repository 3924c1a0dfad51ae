#include "hal/igtl/incoming.h"

#include <algorithm>
#include <string>

namespace orthonav::igtl {
namespace {

constexpr std::uint64_t kLargestBody = 16u << 20u;

}  // namespace

Bytes Incoming::cut_off(Bytes& bytes, std::uint64_t most) {
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(most, bytes.size()));
  const Bytes part = bytes.first(count);
  bytes = bytes.subspan(count);
  return part;
}

Status Incoming::take(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    if (to_come_ > 0) {
      const Bytes part = cut_off(bytes, to_come_);
      if (keeps_) {
        body_.insert(body_.end(), part.begin(), part.end());
      }
      to_come_ -= part.size();
    } else {
      const Bytes part = cut_off(bytes, kHeaderBytes - header_has_);
      std::copy(part.begin(), part.end(),
                header_bytes_.begin() + static_cast<std::ptrdiff_t>(header_has_));
      header_has_ += part.size();
      if (header_has_ < kHeaderBytes) {
        continue;
      }
      if (const Status begun = begin_body(); !begun) {
        return begun;
      }
    }
    if (to_come_ > 0) {
      continue;
    }
    if (const Status ended = end_body(); !ended) {
      return ended;
    }
  }
  return {};
}

Status Incoming::begin_body() {
  header_has_ = 0;
  auto header = parsed_header(std::span<const std::uint8_t, kHeaderBytes>(header_bytes_));
  if (!header) {
    return header.error();
  }
  header_ = std::move(*header);
  if (header_.body_bytes > kLargestBody) {
    return Error{"announces " + header_.type + " of " + std::to_string(header_.body_bytes) +
                 " bytes, limit " + std::to_string(kLargestBody)};
  }
  to_come_ = header_.body_bytes;
  keeps_ = reader_ != nullptr && to_come_ <= kLargestKept && reader_->wants(header_);
  body_.clear();
  ++messages_;
  return {};
}

Status Incoming::end_body() { return keeps_ ? reader_->read(header_, body_) : Status{}; }

}  // namespace orthonav::igtl
