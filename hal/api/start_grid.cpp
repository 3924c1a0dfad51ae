#include "hal/api/start_grid.h"

#include <algorithm>
#include <cstddef>

#include "hal/api/lookup_cell.h"

namespace orthonav {
namespace {

constexpr int kGridCellPx = 8;

/// Cells that no pixel maps to take the start of a neighbour, ring by ring.
void fill_gaps(StartGrid& grid) {
  std::vector<Vec2> next;
  for (bool gaps = true; gaps;) {
    gaps = false;
    next = grid.start_px;
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        Vec2& here = next[static_cast<std::size_t>(row * grid.columns + column)];
        if (!is_nan(here)) {
          continue;
        }
        gaps = true;
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, grid.rows - 1); ++y) {
          for (int x = std::max(column - 1, 0); x <= std::min(column + 1, grid.columns - 1); ++x) {
            const Vec2 from = grid.start_px[static_cast<std::size_t>(y * grid.columns + x)];
            if (!is_nan(from)) {
              here = from;
            }
          }
        }
      }
    }
    grid.start_px.swap(next);
  }
}

}  // namespace

StartGrid start_grid(int width_px, int height_px, std::span<const Vec2> lookup) {
  Vec2 low{1e300, 1e300};
  Vec2 high{-1e300, -1e300};
  for (const Vec2 v : lookup) {
    if (is_nan(v)) {
      continue;
    }
    low = {std::min(low.x, v.x), std::min(low.y, v.y)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y)};
  }
  StartGrid grid;
  grid.columns = std::max(width_px / kGridCellPx, 2);
  grid.rows = std::max(height_px / kGridCellPx, 2);
  grid.origin = low;
  grid.step = {(high.x - low.x) / grid.columns, (high.y - low.y) / grid.rows};
  grid.start_px.assign(static_cast<std::size_t>(grid.columns * grid.rows), kNoDirection);
  for (int row = 0; row + 1 < height_px; ++row) {
    for (int column = 0; column + 1 < width_px; ++column) {
      const LookupCell cell = cell_at(lookup, width_px, column, row);
      if (!cell.valid()) {
        continue;
      }
      const Vec2 v = cell.a;
      const int x = std::clamp(static_cast<int>((v.x - low.x) / grid.step.x), 0, grid.columns - 1);
      const int y = std::clamp(static_cast<int>((v.y - low.y) / grid.step.y), 0, grid.rows - 1);
      grid.start_px[static_cast<std::size_t>(y * grid.columns + x)] = {column + 1.0, row + 1.0};
    }
  }
  fill_gaps(grid);
  return grid;
}

}  // namespace orthonav
