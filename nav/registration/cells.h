#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/vec.h"

namespace orthonav::nav {

/// A cell of a cubic grid over space, by its number along each axis.
using GridCell = std::array<std::int64_t, 3>;

/// The cell that holds a place; cells are centred on multiples of their size.
[[nodiscard]] inline GridCell cell_of(Vec3 p, double size_m) {
  return {std::llround(p.x / size_m), std::llround(p.y / size_m), std::llround(p.z / size_m)};
}

struct HashOfCell {
  std::size_t operator()(const GridCell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t i : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29U;
    }
    return static_cast<std::size_t>(hash);
  }
};

}  // namespace orthonav::nav
