#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/fnv1a.h"
#include "base/printed.h"
#include "base/vec.h"

namespace orthonav::engine {

/// 16 hexadecimal digits.
[[nodiscard]] inline std::string hash_text(std::uint64_t hash) { return printed("%016x", hash); }

/// FNV-1a of values to the bit, one after the other.
class BitHash {
 public:
  void add(std::string_view bytes) {
    hash_ = fnv1a(bytes, hash_);
    add(static_cast<std::uint64_t>(bytes.size()));
  }
  void add(std::uint64_t value) {
    hash_ = fnv1a({reinterpret_cast<const char*>(&value), sizeof(value)}, hash_);
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(Vec3 value) {
    add(value.x);
    add(value.y);
    add(value.z);
  }
  [[nodiscard]] std::string text() const { return hash_text(hash_); }

 private:
  std::uint64_t hash_ = kFnv1aStart;
};

}  // namespace orthonav::engine
