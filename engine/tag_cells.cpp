#include "engine/tag_cells.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <array>
#include <memory>
#include <string_view>

#include "nav/tracking/marker_detector.h"

namespace orthonav::engine {
namespace {

struct Family {
  std::string_view name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array<Family, 9> kFamilies = {{
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    {"tagCircle49h12", tagCircle49h12_create, tagCircle49h12_destroy},
    {"tagCustom48h12", tagCustom48h12_create, tagCustom48h12_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
}};

// The detector's name for the one with the borders of the other two cells wide.
constexpr const char* kWideFamily = "tag36h11b2";
constexpr const char* kNarrowFamily = "tag36h11";

// Everything is black but a ring of white one cell wide, outside the border (or, where the border
// is reversed, the border itself), and the bits that are set.
TagCells cells_of(const apriltag_family_t& family, int id) {
  TagCells tag;
  tag.cells = family.total_width;
  tag.border_cells = family.width_at_border;
  tag.black.assign(static_cast<std::size_t>(tag.cells * tag.cells), 1);
  const auto whiten = [&](int row, int column) {
    tag.black[static_cast<std::size_t>(row * tag.cells + column)] = 0;
  };
  const int ring = family.width_at_border + (family.reversed_border ? 0 : 2);
  const int first = (family.total_width - ring) / 2;
  for (int i = first; i < first + ring; ++i) {
    whiten(first, i);
    whiten(first + ring - 1, i);
    whiten(i, first);
    whiten(i, first + ring - 1);
  }
  const int border = (family.total_width - family.width_at_border) / 2;
  const std::uint64_t code = family.codes[id];
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit)
    if ((code >> (family.nbits - bit - 1)) & 1U)
      whiten(static_cast<int>(family.bit_y[bit]) + border,
             static_cast<int>(family.bit_x[bit]) + border);
  return tag;
}

/// White outside, a second ring of black, then what lay inside the white ring.
TagCells with_wide_border(const TagCells& narrow) {
  TagCells wide;
  wide.cells = narrow.cells + 2;
  wide.border_cells = narrow.border_cells + 2;
  wide.black.assign(static_cast<std::size_t>(wide.cells * wide.cells), 0);
  const int last = wide.cells - 2;
  for (int row = 1; row <= last; ++row)
    for (int column = 1; column <= last; ++column) {
      const bool added = row == 1 || column == 1 || row == last || column == last;
      wide.black[static_cast<std::size_t>(row * wide.cells + column)] =
          added || narrow.is_black(row - 1, column - 1) ? 1 : 0;
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
    if (border_width == 1) return tag_cells(kNarrowFamily, id, 2);
    return Error{family + std::string(" is ") + kNarrowFamily + " with borders 2 cells wide"};
  }
  if (border_width != 1 && border_width != 2)
    return Error{"tag border of " + std::to_string(border_width) + " cells, must be 1 or 2"};
  for (const Family& known : kFamilies) {
    if (known.name != family) continue;
    const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> tables(known.create(),
                                                                                  known.destroy);
    if (id < 0 || id >= static_cast<int>(tables->ncodes))
      return Error{"tag id " + std::to_string(id) + " of " + family + ", must be 0-" +
                   std::to_string(tables->ncodes - 1)};
    TagCells tag = cells_of(*tables, id);
    if (border_width == 1) return tag;
    if (tag.overhang_cells() > 0)
      return Error{family + " has no black border that could be 2 cells wide"};
    return with_wide_border(tag);
  }
  return Error{"unknown tag family '" + family + "', known are " + nav::known_families_text()};
}

}  // namespace orthonav::engine
