#pragma once

#include <array>

#include "base/image.h"
#include "base/vec.h"
#include "nav/tracking/pixel_box.h"

namespace orthonav::nav {

/// Shrinks dark areas in a part of an image: every pixel becomes the brightest of a window of
/// `window_px` pixels per side that begins with it and extends to the right and down. The black
/// squares between the tags of an AprilGrid touch their corners; this separates them, so that the
/// tags' outlines appear. A position in `thinned` corresponds in `image` to the same position plus
/// the box's corner and `thinned_offset(window_px)`.
void thin(const GreyImage& image, const PixelBox& box, int window_px, GreyImage& thinned);
[[nodiscard]] inline Vec2 thinned_offset(int window_px) {
  return {0.5 * (window_px - 1), 0.5 * (window_px - 1)};
}

/// Whether the second ring of cells in a tag of ten by ten is black all round, as in a border two
/// cells wide. A tag with a plain border carries code there and can decode as the other family's.
/// Corners in the order of `MarkerCorners`, or in any other cyclic order.
[[nodiscard]] bool has_wide_border(const GreyImage& image, const std::array<Vec2, 4>& corners_px);

}  // namespace orthonav::nav
