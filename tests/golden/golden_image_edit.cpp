#include "tests/golden/golden_image_edit.h"

#include <algorithm>
#include <cstddef>

namespace orthonav::engine {
namespace {

/// Calls `edit` with begin and end of each view's part of each row; a pixel has so many values.
template <class Values, class Edit>
void each_part(Values& values, int width_px, int views, std::ptrdiff_t per_pixel,
               const Edit& edit) {
  const std::ptrdiff_t part = width_px / views * per_pixel;
  for (auto at = values.begin(); at < values.end(); at += part) {
    edit(at, at + part);
  }
}

void mirror(std::vector<std::uint8_t>& rgba, int width_px, int views) {
  each_part(rgba, width_px, views, 4, [](auto begin, auto end) {
    for (auto a = begin, b = end - 4; a < b; a += 4, b -= 4) {
      std::swap_ranges(a, a + 4, b);
    }
  });
}

template <class Values>
void swap_halves(Values& values, int width_px, std::ptrdiff_t per_pixel) {
  each_part(values, width_px, 1, per_pixel, [](auto begin, auto end) {
    std::swap_ranges(begin, begin + (end - begin) / 2, begin + (end - begin) / 2);
  });
}

}  // namespace

GoldenImages mirrored(const GoldenImages& images, int views) {
  GoldenImages out = images;
  each_part(out.labels.labels, out.labels.width_px, views, 1,
            [](auto begin, auto end) { std::reverse(begin, end); });
  mirror(out.additive.pixels, out.additive.width_px, views);
  mirror(out.over.pixels, out.over.width_px, views);
  return out;
}

GoldenImages eyes_swapped(const GoldenImages& images) {
  GoldenImages out = images;
  swap_halves(out.labels.labels, out.labels.width_px, 1);
  swap_halves(out.additive.pixels, out.additive.width_px, 4);
  swap_halves(out.over.pixels, out.over.width_px, 4);
  return out;
}

}  // namespace orthonav::engine
