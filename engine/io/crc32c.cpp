#include "engine/io/crc32c.h"

#include <array>

namespace orthonav::engine {
namespace {

constexpr std::array<std::uint32_t, 256> table() {
  constexpr std::uint32_t kReversedPolynomial = 0x82f63b78u;
  std::array<std::uint32_t, 256> values{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest >> 1u) ^ ((rest & 1u) != 0 ? kReversedPolynomial : 0u);
    }
    values[byte] = rest;
  }
  return values;
}

constexpr std::array<std::uint32_t, 256> kTable = table();

}  // namespace

std::uint32_t crc32c(std::string_view bytes, std::uint32_t before) {
  std::uint32_t rest = ~before;
  for (const char c : bytes) {
    rest = kTable[(rest ^ static_cast<unsigned char>(c)) & 0xffu] ^ (rest >> 8u);
  }
  return ~rest;
}

}  // namespace orthonav::engine
