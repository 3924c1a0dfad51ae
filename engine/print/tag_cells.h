#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"

namespace orthonav::engine {

/// A printed tag as a square of cells, seen upright, row 0 on top, with everything that the family
/// defines: the white ring around a black border, or the bits that lie outside a white one.
struct TagCells {
  int cells = 0;                    ///< a side of the whole pattern
  int border_cells = 0;             ///< a side of the square whose outer edge is the tag's size
  std::vector<std::uint8_t> black;  ///< row-major, 1: black

  [[nodiscard]] bool is_black(int row, int column) const {
    return black[static_cast<std::size_t>(row * cells + column)] != 0;
  }
  /// Cells on each side of the size's square that may be black.
  [[nodiscard]] int overhang_cells() const;
};

/// The pattern of one tag from the AprilTag library's tables. With `border_width` 2 its black
/// border is two cells wide, as on Kalibr's AprilGrid: the bits stay, and the size has two more
/// cells. Refuses unknown families and ids, other widths, and two cells for a family whose border
/// is white or is surrounded by bits.
Result<TagCells> tag_cells(const std::string& family, int id, int border_width = 1);

}  // namespace orthonav::engine
