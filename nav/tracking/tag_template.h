#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace orthonav::nav {

/// A printed tag's pattern: a square of cells, seen upright, row 0 on top, from one edge of the
/// part that the family defines to the other (including its white ring, if it has one).
struct TagTemplate {
  int cells = 0;             ///< per side
  int border_cells = 0;      ///< per side of the square whose outer edge is the tag's size
  std::vector<float> white;  ///< row-major, 1: white, 0: black
  std::vector<bool> code;    ///< row-major, whether the cell distinguishes ids

  [[nodiscard]] float at(int row, int column) const {
    return white[static_cast<std::size_t>(row * cells + column)];
  }
  /// Length of a cell on a tag of the given size.
  [[nodiscard]] double cell_m(double size_m) const { return size_m / border_cells; }
};

/// The template of a tag from the AprilTag library's tables; nothing for a family or an id that
/// does not exist.
[[nodiscard]] std::optional<TagTemplate> tag_template(std::string_view family, int id);

}  // namespace orthonav::nav
