#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// The next unit's payload in a stream of NAL units with start codes (Annex B of H.264), from `at`
/// on; `at` moves past it; empty at the end.
[[nodiscard]] Bytes next_unit(Bytes stream, std::size_t& at);

/// The bits of a NAL unit's first 512 bytes, highest first, without emulation prevention bytes.
/// Headers of pictures and parameter sets lie there, except after scaling lists.
class BitReader {
 public:
  explicit BitReader(Bytes unit);
  /// At most 32; 0 past the end, and then `ok` is false.
  std::uint32_t bits(std::uint32_t count);
  void skip(std::uint32_t count);
  bool flag() { return bits(1) != 0; }
  /// Exp-Golomb, unsigned (H.264 9.1).
  std::uint32_t golomb();
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  static constexpr std::size_t kMostRead = 512;

  std::array<std::uint8_t, kMostRead> bytes_{};
  std::size_t count_ = 0;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace orthonav::hl2ss
