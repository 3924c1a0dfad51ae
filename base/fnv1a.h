#pragma once

#include <cstdint>
#include <string_view>

namespace orthonav {

inline constexpr std::uint64_t kFnv1aStart = 0xcbf29ce484222325U;

/// FNV-1a, 64 bits, of `bytes`, continued from the hash `before`. Tells whether data changed: it
/// protects against mix-ups, not against malice.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::string_view bytes,
                                            std::uint64_t before = kFnv1aStart) {
  for (const char byte : bytes) {
    before = (before ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  }
  return before;
}

}  // namespace orthonav
