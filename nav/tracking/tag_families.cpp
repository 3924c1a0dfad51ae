#include "nav/tracking/tag_families.h"

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

#include "nav/tracking/tool.h"

namespace orthonav::nav {
namespace {

struct Family {
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
  int codes;
};

/// The library finds quads at the outer edge of the border, and samples bits and grey levels in
/// cells counted from there: two cells of border push the bits in by one.
apriltag_family_t* tag36h11b2_create() {
  apriltag_family_t* family = tag36h11_create();
  if (!family) {
    return nullptr;
  }
  family->width_at_border += 2;
  family->total_width += 2;
  for (std::uint32_t i = 0; i < family->nbits; ++i) {
    ++family->bit_x[i];
    ++family->bit_y[i];
  }
  return family;
}

constexpr std::array<std::string_view, 10> kNames = {
    "tag36h11",      "tag25h9",        "tag16h5",        "tagStandard41h12", "tagStandard52h13",
    "tagCircle21h7", "tagCircle49h12", "tagCustom48h12", "tag36h10",         kWideFamily};
constexpr std::array<Family, kNames.size()> kFamilies = {{
    {tag36h11_create, tag36h11_destroy, 587},
    {tag25h9_create, tag25h9_destroy, 35},
    {tag16h5_create, tag16h5_destroy, 30},
    {tagStandard41h12_create, tagStandard41h12_destroy, 2115},
    {tagStandard52h13_create, tagStandard52h13_destroy, 48714},
    {tagCircle21h7_create, tagCircle21h7_destroy, 38},
    {tagCircle49h12_create, tagCircle49h12_destroy, 65535},
    {tagCustom48h12_create, tagCustom48h12_destroy, 42211},
    {tag36h10_create, tag36h10_destroy, 2320},
    {tag36h11b2_create, tag36h11_destroy, 587},
}};

std::size_t family_index(std::string_view name) {
  return static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

}  // namespace

void FreeFamily::operator()(apriltag_family* family) const { kFamilies[index].destroy(family); }

TagFamily create_family(std::string_view name) {
  const std::size_t index = family_index(name);
  if (index >= kFamilies.size()) {
    return {};
  }
  return {kFamilies[index].create(), FreeFamily{index}};
}

std::span<const std::string_view> known_families() { return kNames; }

std::string known_families_text() {
  std::string text;
  for (const std::string_view name : kNames) {
    if (!text.empty()) {
      text += ", ";
    }
    text += name;
  }
  return text;
}

int family_size(std::string_view family) {
  const std::size_t index = family_index(family);
  return index < kFamilies.size() ? kFamilies[index].codes : 0;
}

std::optional<TagCode> tag_code(std::string_view family, int id) {
  const std::size_t index = family_index(family);
  if (index >= kFamilies.size() || id < 0 || id >= kFamilies[index].codes) {
    return std::nullopt;
  }
  const TagFamily table = create_family(family);
  if (!table) {
    return std::nullopt;
  }
  TagCode code{table->total_width, table->width_at_border, table->reversed_border, {}};
  for (std::uint32_t bit = 0; bit < table->nbits; ++bit) {
    code.bits.push_back({static_cast<int>(table->bit_y[bit]), static_cast<int>(table->bit_x[bit]),
                         ((table->codes[id] >> (table->nbits - bit - 1)) & 1U) != 0});
  }
  return code;
}

bool is_known_family(const std::string& family) { return family_index(family) < kNames.size(); }

}  // namespace orthonav::nav
