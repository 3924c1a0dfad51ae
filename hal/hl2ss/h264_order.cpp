#include "hal/hl2ss/h264_order.h"

#include <algorithm>
#include <array>
#include <string>

#include "hal/hl2ss/annex_b.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::uint8_t kSlice = 1;
constexpr std::uint8_t kKeySlice = 5;
constexpr std::uint8_t kSequenceParameters = 7;

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
