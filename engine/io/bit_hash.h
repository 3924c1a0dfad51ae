#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/printed.h"
#include "base/vec.h"

namespace orthonav::engine {

/// FNV-1a, 64 bits, of values to the bit: whether something is what it was. Against mix-ups, not
/// against malice.
class BitHash {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) {
      add_byte(static_cast<unsigned char>(c));
    }
    add(static_cast<std::uint64_t>(bytes.size()));
  }
  void add(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) {
      add_byte(static_cast<unsigned char>((value >> shift) & 0xffu));
    }
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(Vec3 value) {
    add(value.x);
    add(value.y);
    add(value.z);
  }
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const {
    return printed("%08x%08x", static_cast<std::uint32_t>(hash_ >> 32u),
                   static_cast<std::uint32_t>(hash_));
  }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }

  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace orthonav::engine
