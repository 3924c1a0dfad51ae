#include "hal/hl2ss/annex_b.h"

#include <algorithm>

namespace orthonav::hl2ss {

Bytes next_unit(Bytes stream, std::size_t& at) {
  const auto start_code = [&](std::size_t i) {
    return i + 3 <= stream.size() && stream[i] == 0 && stream[i + 1] == 0 && stream[i + 2] == 1;
  };
  while (at < stream.size() && !start_code(at)) {
    ++at;
  }
  if (at >= stream.size()) {
    return {};
  }
  const std::size_t begin = at + 3;
  at = begin;
  while (at < stream.size() && !start_code(at)) {
    ++at;
  }
  return stream.subspan(begin, at - begin);
}

BitReader::BitReader(Bytes unit) {
  int zeros = 0;
  for (const std::uint8_t byte : unit.first(std::min(unit.size(), kMostRead))) {
    if (zeros >= 2 && byte == 3) {
      zeros = 0;
      continue;
    }
    zeros = byte == 0 ? zeros + 1 : 0;
    bytes_[count_++] = byte;
  }
}

std::uint32_t BitReader::bits(std::uint32_t count) {
  std::uint32_t value = 0;
  for (; count > 0; --count) {
    if (at_ / 8 >= count_) {
      ok_ = false;
      return 0;
    }
    value = value << 1 | (bytes_[at_ / 8] >> (7 - at_ % 8) & 1u);
    ++at_;
  }
  return value;
}

void BitReader::skip(std::uint32_t count) {
  at_ += count;
  ok_ = ok_ && at_ <= 8 * count_;
}

std::uint32_t BitReader::golomb() {
  std::uint32_t zeros = 0;
  while (ok_ && bits(1) == 0) {
    ++zeros;
  }
  if (!ok_ || zeros > 31) {
    ok_ = false;
    return 0;
  }
  return zeros == 0 ? 0 : (1u << zeros) - 1 + bits(zeros);
}

}  // namespace orthonav::hl2ss
