#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/hl2ss/server/depth_bytes.h"
#include "hal/sim/cameras/depth_model.h"

namespace orthonav::hl2ss::depth_parser_test {

/// What AHaT's server says of its calibration.
inline std::vector<std::uint8_t> ahat_answer() {
  static const auto kAnswer = depth_answer_bytes(sim::calibration_of(sim::hololens2_ahat()));
  return kAnswer;
}

// Where its numbers lie: two tables, a matrix, scale, alias.
inline constexpr std::size_t kAhatTable = std::size_t{4} * 512 * 512;
inline constexpr std::size_t kExtrinsicsAt = 2 * kAhatTable;
inline constexpr std::size_t kScaleAt = kExtrinsicsAt + 64;
inline constexpr std::size_t kAliasAt = kScaleAt + 4;

}  // namespace orthonav::hl2ss::depth_parser_test
