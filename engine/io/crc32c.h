#pragma once

#include <cstdint>
#include <string_view>

namespace orthonav::engine {

/// CRC-32C (Castagnoli; RFC 3720, appendix B.4) of `bytes`, continued from the checksum `before`.
[[nodiscard]] std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = 0);

}  // namespace orthonav::engine
