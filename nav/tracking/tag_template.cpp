#include "nav/tracking/tag_template.h"

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

#include <algorithm>
#include <array>
#include <memory>

namespace orthonav::nav {
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

// Everything is black but a ring of white one cell wide, outside the border (or, where the border
// is reversed, the border itself), and the bits that are set.
TagTemplate template_of(const apriltag_family_t& family, int id) {
  TagTemplate tag;
  tag.cells = family.total_width;
  tag.border_cells = family.width_at_border;
  tag.white.assign(static_cast<std::size_t>(tag.cells * tag.cells), 0.0F);
  tag.code.assign(tag.white.size(), false);
  const auto whiten = [&](int row, int column) {
    tag.white[static_cast<std::size_t>(row * tag.cells + column)] = 1.0F;
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
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
    const int row = static_cast<int>(family.bit_y[bit]) + border;
    const int column = static_cast<int>(family.bit_x[bit]) + border;
    tag.code[static_cast<std::size_t>(row * tag.cells + column)] = true;
    if ((code >> (family.nbits - bit - 1)) & 1U) whiten(row, column);
  }
  return tag;
}

/// The same code inside a black border two cells wide.
TagTemplate widened(const TagTemplate& tag) {
  TagTemplate wide;
  wide.cells = tag.cells + 2;
  wide.border_cells = tag.border_cells + 2;
  wide.white.assign(static_cast<std::size_t>(wide.cells * wide.cells), 0.0F);
  wide.code.assign(wide.white.size(), false);
  const int last = wide.cells - 1;
  for (int row = 0; row < wide.cells; ++row)
    for (int column = 0; column < wide.cells; ++column) {
      const bool ring = row == 0 || column == 0 || row == last || column == last;
      const bool code = std::min({row, column, last - row, last - column}) > 2;
      const auto i = static_cast<std::size_t>(row * wide.cells + column);
      wide.white[i] = ring ? 1.0F : (code ? tag.at(row - 1, column - 1) : 0.0F);
      wide.code[i] = code;
    }
  return wide;
}

}  // namespace

std::optional<TagTemplate> tag_template(std::string_view name, int id) {
  if (name == "tag36h11b2") {
    const auto plain = tag_template("tag36h11", id);
    return plain ? std::optional(widened(*plain)) : std::nullopt;
  }
  for (const Family& known : kFamilies) {
    if (known.name != name) continue;
    const std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family(known.create(),
                                                                                  known.destroy);
    if (!family || id < 0 || id >= static_cast<int>(family->ncodes)) return std::nullopt;
    return template_of(*family, id);
  }
  return std::nullopt;
}

}  // namespace orthonav::nav
