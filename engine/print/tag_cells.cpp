#include "engine/print/tag_cells.h"

#include "nav/tracking/marker_detector.h"

namespace orthonav::engine {
namespace {

// The detector's name for the family whose border is two cells wide.
constexpr const char* kWideFamily = "tag36h11b2";
constexpr const char* kNarrowFamily = "tag36h11";

TagCells cells_of(const nav::TagTemplate& known) {
  TagCells tag{known.cells, known.border_cells, {}};
  for (const float white : known.white) {
    tag.black.push_back(white < 0.5F ? 1 : 0);
  }
  return tag;
}

/// White outside, a second ring of black, then what lay inside the white ring.
TagCells with_wide_border(const TagCells& narrow) {
  TagCells wide;
  wide.cells = narrow.cells + 2;
  wide.border_cells = narrow.border_cells + 2;
  wide.black.assign(static_cast<std::size_t>(wide.cells * wide.cells), 0);
  const int last = wide.cells - 2;
  for (int row = 1; row <= last; ++row) {
    for (int column = 1; column <= last; ++column) {
      const bool added = row == 1 || column == 1 || row == last || column == last;
      wide.black[static_cast<std::size_t>(row * wide.cells + column)] =
          added || narrow.is_black(row - 1, column - 1) ? 1 : 0;
    }
  }
  return wide;
}

}  // namespace

int TagCells::overhang_cells() const {
  const int around = (cells - border_cells) / 2;
  // One cell around is the white ring of the classic families.
  return around > 1 ? around : 0;
}

Result<TagCells> tag_cells(const std::string& family, int id, int border_width) {
  if (family == kWideFamily) {
    if (border_width == 1) {
      return tag_cells(kNarrowFamily, id, 2);
    }
    return Error{family + std::string(" is ") + kNarrowFamily + " with borders 2 cells wide"};
  }
  if (border_width != 1 && border_width != 2) {
    return Error{"tag border of " + std::to_string(border_width) + " cells, must be 1 or 2"};
  }
  const int codes = nav::family_size(family);
  if (codes == 0) {
    return Error{"unknown tag family '" + family + "', known are " + nav::known_families_text()};
  }
  const auto known = nav::tag_template(family, id);
  if (!known) {
    return Error{"tag id " + std::to_string(id) + " of " + family + ", must be 0-" +
                 std::to_string(codes - 1)};
  }
  TagCells tag = cells_of(*known);
  if (border_width == 1) {
    return tag;
  }
  if (tag.overhang_cells() > 0) {
    return Error{family + " has no black border that could be 2 cells wide"};
  }
  return with_wide_border(tag);
}

}  // namespace orthonav::engine
