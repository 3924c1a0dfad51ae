#include "hal/hl2ss/hevc_order.h"

#include <array>
#include <cstddef>
#include <string>

#include "hal/hl2ss/annex_b.h"

namespace orthonav::hl2ss {
namespace {

// nal_unit_type (table 7-1).
constexpr std::uint8_t kLastOrdinarySlice = 9;
constexpr std::uint8_t kFirstKeySlice = 16;
constexpr std::uint8_t kRefreshWithLeading = 19;
constexpr std::uint8_t kRefresh = 20;
constexpr std::uint8_t kLastKeySlice = 23;
constexpr std::uint8_t kSequenceSet = 33;
constexpr std::uint8_t kPictureSet = 34;
constexpr std::size_t kUnitHeaderBytes = 2;

bool is_key(std::uint8_t kind) { return kind >= kFirstKeySlice && kind <= kLastKeySlice; }

/// Skips profile_tier_level (7.3.3) for `below` layers below the highest.
void skip_profile(BitReader& reader, std::uint32_t below) {
  constexpr std::uint32_t kProfileBits = 88;
  constexpr std::uint32_t kLevelBits = 8;
  constexpr std::uint32_t kMostLayers = 8;
  reader.skip(kProfileBits + kLevelBits);
  std::array<bool, kMostLayers> has_profile{};
  std::array<bool, kMostLayers> has_level{};
  for (std::uint32_t i = 0; i < below; ++i) {
    has_profile[i] = reader.flag();
    has_level[i] = reader.flag();
  }
  if (below > 0) {
    reader.skip(2 * (kMostLayers - below));
  }
  for (std::uint32_t i = 0; i < below; ++i) {
    reader.skip((has_profile[i] ? kProfileBits : 0) + (has_level[i] ? kLevelBits : 0));
  }
}

}  // namespace

Status HevcOrder::read_parameters(std::uint8_t kind, Bytes unit) {
  BitReader reader(unit);
  SliceFormat read = format_;
  if (kind == kPictureSet) {
    reader.golomb();  // its own id, and the sequence set's
    reader.golomb();
    reader.flag();  // dependent slice segments; none is the first of its picture
    read.says_output = reader.flag();
    read.extra_bits = reader.bits(3);
    read.has_picture_set = true;
  } else {
    reader.skip(4);  // id of the video parameter set
    const std::uint32_t below = reader.bits(3);
    reader.skip(1);  // nesting
    skip_profile(reader, below);
    reader.golomb();  // id
    const std::uint32_t chroma = reader.golomb();
    read.has_planes = chroma == 3 && reader.flag();
    reader.golomb();  // width and height
    reader.golomb();
    if (reader.flag()) {
      for (int side = 0; side < 4; ++side) {
        reader.golomb();  // conformance window
      }
    }
    reader.golomb();  // bit depths
    reader.golomb();
    read.count_bits = reader.golomb() + 4;
  }
  if (!reader.ok() || read.count_bits > 16) {
    return Error{"HEVC parameter set is damaged"};
  }
  format_ = read;
  return {};
}

Status HevcOrder::follow(Bytes access_unit) {
  std::size_t at = 0;
  for (Bytes unit = next_unit(access_unit, at); !unit.empty(); unit = next_unit(access_unit, at)) {
    const std::uint8_t kind = unit[0] >> 1 & 63u;
    if (unit.size() <= kUnitHeaderBytes) {
      continue;
    }
    const Bytes payload = unit.subspan(kUnitHeaderBytes);
    if (kind == kSequenceSet || kind == kPictureSet) {
      if (Status read = read_parameters(kind, payload); !read) {
        return read;
      }
    } else if (kind <= kLastOrdinarySlice || is_key(kind)) {
      // One slice is enough for its picture.
      return follow_slice(kind, payload);
    }
  }
  return {};
}

Status HevcOrder::follow_slice(std::uint8_t kind, Bytes unit) {
  if (kind == kRefresh || kind == kRefreshWithLeading) {
    last_count_ = 0;
    return {};
  }
  if (format_.count_bits == 0 || !format_.has_picture_set) {
    return Error{"HEVC picture comes before its parameters"};
  }
  BitReader reader(unit);
  const bool is_first_slice = reader.flag();
  if (is_key(kind)) {
    reader.flag();  // no output of prior pictures
  }
  reader.golomb();  // picture parameter set
  reader.skip(format_.extra_bits);
  reader.golomb();  // slice type
  if (format_.says_output) {
    reader.flag();
  }
  if (format_.has_planes) {
    reader.skip(2);
  }
  const std::uint32_t count = reader.bits(format_.count_bits);
  if (!reader.ok() || !is_first_slice) {
    last_count_.reset();
    return Error{"HEVC slice is damaged"};
  }
  const auto last = last_count_;
  last_count_ = count;
  const std::uint32_t largest = (1u << format_.count_bits) - 1;
  if (is_key(kind) || !last || count == ((*last + 1) & largest)) {
    return {};
  }
  last_count_.reset();
  return Error{"HEVC pictures are missing: number " + std::to_string(count) + " comes after " +
               std::to_string(*last)};
}

}  // namespace orthonav::hl2ss
