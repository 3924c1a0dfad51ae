#include "hal/hl2ss/h264_order.h"

#include <algorithm>
#include <array>
#include <string>

namespace orthonav::hl2ss {
namespace {

constexpr std::uint8_t kSlice = 1;
constexpr std::uint8_t kKeySlice = 5;
constexpr std::uint8_t kSequenceParameters = 7;
/// Everything read from a unit lies in its first bytes, except in a parameter set with scaling
/// lists.
constexpr std::size_t kMostRead = 512;

/// The bits of a unit, highest first, without emulation prevention bytes.
class BitReader {
 public:
  explicit BitReader(Bytes unit) {
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
  std::uint32_t bits(std::uint32_t count) {
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
  /// Exp-Golomb (9.1).
  std::uint32_t golomb() {
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
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  std::array<std::uint8_t, kMostRead> bytes_{};
  std::size_t count_ = 0;
  std::size_t at_ = 0;
  bool ok_ = true;
};

void skip_scaling_list(BitReader& reader, int size) {
  std::int64_t last = 8;
  std::int64_t next = 8;
  for (int i = 0; i < size && reader.ok(); ++i) {
    if (next != 0) {
      const std::int64_t coded = reader.golomb();
      next = (last + (coded % 2 != 0 ? (coded + 1) / 2 : -coded / 2) + 256) % 256;
    }
    if (next != 0) {
      last = next;
    }
  }
}

bool has_chroma_format(std::uint32_t profile) {
  constexpr std::array<std::uint32_t, 13> kProfiles = {100, 110, 122, 244, 44,  83, 86,
                                                       118, 128, 138, 139, 134, 135};
  return std::find(kProfiles.begin(), kProfiles.end(), profile) != kProfiles.end();
}

/// The number of bits of `frame_num`, from a sequence parameter set; 0 for a damaged one.
std::uint32_t frame_num_bits(Bytes unit) {
  BitReader reader(unit);
  const std::uint32_t profile = reader.bits(8);
  reader.bits(16);  // constraints, level
  reader.golomb();  // id
  if (has_chroma_format(profile)) {
    const std::uint32_t chroma = reader.golomb();
    if (chroma == 3) {
      reader.bits(1);
    }
    reader.golomb();  // bit depths
    reader.golomb();
    reader.bits(1);  // bypass
    if (reader.bits(1) != 0) {
      for (int list = 0; list < (chroma == 3 ? 12 : 8) && reader.ok(); ++list) {
        if (reader.bits(1) != 0) {
          skip_scaling_list(reader, list < 6 ? 16 : 64);
        }
      }
    }
  }
  const std::uint32_t bits = reader.golomb() + 4;
  return reader.ok() && bits <= 16 ? bits : 0;
}

/// The next unit's payload from `at` on; `at` moves past it; empty at the end.
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

}  // namespace

Status H264Order::follow(Bytes access_unit) {
  std::size_t at = 0;
  for (Bytes unit = next_unit(access_unit, at); !unit.empty(); unit = next_unit(access_unit, at)) {
    const std::uint8_t kind = unit[0] & 31u;
    if (kind == kSequenceParameters) {
      frame_num_bits_ = frame_num_bits(unit.subspan(1));
      if (frame_num_bits_ == 0) {
        return Error{"H.264 parameter set is damaged"};
      }
    }
    if (kind != kSlice && kind != kKeySlice) {
      continue;
    }
    if (frame_num_bits_ == 0) {
      return Error{"H.264 picture comes before its parameters"};
    }
    BitReader reader(unit.subspan(1));
    reader.golomb();  // first macroblock
    reader.golomb();  // slice type
    reader.golomb();  // picture parameter set
    const std::uint32_t frame_num = reader.bits(frame_num_bits_);
    if (!reader.ok()) {
      return Error{"H.264 slice is damaged"};
    }
    // One slice is enough for its picture.
    return follow({frame_num, (unit[0] >> 5 & 3u) != 0}, kind == kKeySlice);
  }
  return {};
}

Status H264Order::follow(const Picture& next, bool is_key) {
  const auto last = last_;
  last_ = next;
  if (is_key || !last) {
    return {};
  }
  const std::uint32_t largest = (1u << frame_num_bits_) - 1;
  const std::uint32_t after = (last->frame_num + 1) & largest;
  const bool is_next = next.frame_num == after;
  const bool repeats = next.frame_num == last->frame_num && !last->is_reference;
  if (is_next || repeats) {
    return {};
  }
  last_.reset();
  return Error{"H.264 pictures are missing: number " + std::to_string(next.frame_num) +
               " comes after " + std::to_string(last->frame_num)};
}

}  // namespace orthonav::hl2ss
