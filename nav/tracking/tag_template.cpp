#include "nav/tracking/tag_template.h"

#include "nav/tracking/marker_detector.h"

namespace orthonav::nav {

// Everything is black except a white ring one cell wide outside the border (or, where the border is
// white, the border itself) and the bits that are set.
std::optional<TagTemplate> tag_template(std::string_view family, int id) {
  const auto code = tag_code(family, id);
  if (!code) {
    return std::nullopt;
  }
  TagTemplate tag;
  tag.cells = code->cells;
  tag.border_cells = code->border_cells;
  tag.white.assign(static_cast<std::size_t>(tag.cells * tag.cells), 0.0F);
  tag.code.assign(tag.white.size(), false);
  const auto index = [&](int row, int column) {
    return static_cast<std::size_t>(row * tag.cells + column);
  };
  const int ring = tag.border_cells + (code->white_border ? 0 : 2);
  const int first = (tag.cells - ring) / 2;
  const int last = first + ring - 1;
  for (int i = first; i <= last; ++i) {
    tag.white[index(first, i)] = tag.white[index(last, i)] = tag.white[index(i, first)] =
        tag.white[index(i, last)] = 1.0F;
  }
  const int border = (tag.cells - tag.border_cells) / 2;
  for (const TagCode::Bit& bit : code->bits) {
    const std::size_t i = index(bit.row + border, bit.column + border);
    tag.code[i] = true;
    if (bit.white) {
      tag.white[i] = 1.0F;
    }
  }
  return tag;
}

}  // namespace orthonav::nav
