#pragma once

#include <span>
#include <vector>

#include "base/vec.h"

namespace orthonav {

/// A coarse grid over the unit plane that holds a starting pixel for Newton's iteration in each
/// cell.
struct StartGrid {
  int columns = 0;
  int rows = 0;
  Vec2 origin{};  ///< on the unit plane, as is the step
  Vec2 step{};
  std::vector<Vec2> start_px;  ///< row-major
};

/// From a checked look-up table, row-major, NaN where a pixel has no direction.
[[nodiscard]] StartGrid start_grid(int width_px, int height_px, std::span<const Vec2> lookup);

}  // namespace orthonav
