#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orthonav::sim {

/// A printed tag as a square of cells, seen upright: row 0 on top, its white margin included.
struct TagPattern {
  int cells = 0;         ///< across the whole pattern
  int border_cells = 0;  ///< across the outer edge of the border, which the tag's size measures
  std::vector<std::uint8_t> black;  ///< row-major, 1: black

  [[nodiscard]] bool is_black(int row, int column) const {
    if (row < 0 || column < 0 || row >= cells || column >= cells) {
      return false;
    }
    return black[static_cast<std::size_t>(row * cells + column)] != 0;
  }
};

/// How many ids a family has; 0 for an unknown one.
[[nodiscard]] int tag_count(const std::string& family);
/// The families that can be drawn, for messages: "tag36h11, ...".
[[nodiscard]] std::string tag_families();
/// The pattern from libapriltag's own tables; nothing for an unknown family or id.
[[nodiscard]] std::optional<TagPattern> tag_pattern(const std::string& family, int id);

}  // namespace orthonav::sim
