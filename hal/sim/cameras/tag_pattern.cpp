#include "hal/sim/cameras/tag_pattern.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <array>
#include <memory>

namespace orthonav::sim {
namespace {

struct Family {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array<Family, 6> kFamilies = {{
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
}};

using OpenFamily = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

/// The library's tables of a family; null for an unknown one.
OpenFamily opened(const std::string& name) {
  for (const Family& known : kFamilies) {
    if (name == known.name) {
      return {known.create(), known.destroy};
    }
  }
  return {nullptr, [](apriltag_family_t*) {}};
}

/// Everything is black except a white ring one cell wide outside the border (or, where the border
/// is reversed, the border itself) and the bits that are set.
TagPattern pattern_of(const apriltag_family_t& family, int id) {
  TagPattern pattern;
  pattern.cells = family.total_width;
  pattern.border_cells = family.width_at_border;
  pattern.black.assign(static_cast<std::size_t>(pattern.cells * pattern.cells), 1);
  const auto whiten = [&](int row, int column) {
    pattern.black[static_cast<std::size_t>(row * pattern.cells + column)] = 0;
  };
  const int ring = family.width_at_border + (family.reversed_border ? 0 : 2);
  const int first = (family.total_width - ring) / 2;
  const int last = first + ring - 1;
  for (int i = first; i <= last; ++i) {
    whiten(first, i);
    whiten(last, i);
    whiten(i, first);
    whiten(i, last);
  }
  const int border = (family.total_width - family.width_at_border) / 2;
  const std::uint64_t code = family.codes[id];
  for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
    if ((code >> (family.nbits - bit - 1)) & 1U) {
      whiten(static_cast<int>(family.bit_y[bit]) + border,
             static_cast<int>(family.bit_x[bit]) + border);
    }
  }
  return pattern;
}

}  // namespace

int tag_count(const std::string& name) {
  const auto family = opened(name);
  return family ? static_cast<int>(family->ncodes) : 0;
}

std::string tag_families() {
  std::string names;
  for (const Family& known : kFamilies) {
    if (!names.empty()) {
      names += ", ";
    }
    names += known.name;
  }
  return names;
}

std::optional<TagPattern> tag_pattern(const std::string& name, int id) {
  const auto family = opened(name);
  if (!family || id < 0 || id >= static_cast<int>(family->ncodes)) {
    return std::nullopt;
  }
  return pattern_of(*family, id);
}

}  // namespace orthonav::sim
