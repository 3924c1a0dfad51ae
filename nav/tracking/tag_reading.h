#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/image.h"
#include "base/vec.h"
#include "nav/tracking/marker_detector.h"

struct apriltag_family;

namespace orthonav::nav {

/// Shrinks dark areas in a part of an image: every pixel becomes the brightest of a window of
/// `window_px` pixels per side that begins with it and extends to the right and down. Black squares
/// that touch a tag's corners are one dark area with it; this separates them, so that the tag's
/// outline appears. A position in `thinned` corresponds in `image` to the same position plus the
/// box's corner and `thinned_offset(window_px)`.
void thin(const GreyImage& image, const PixelBox& box, int window_px, GreyImage& thinned);
[[nodiscard]] inline Vec2 thinned_offset(int window_px) {
  return {0.5 * (window_px - 1), 0.5 * (window_px - 1)};
}

/// The tag of a family with a black border that these corners outline, in any cyclic order or
/// sense: with corners as `MarkerCorners` has them, and margin and corrected bits as the library
/// counts them. Nothing where bits differ from every code by more than `max_hamming`, where a cell
/// or two of the border are bright, or where the surroundings are not brighter than the border
/// (the corners of the surroundings do not count). `touched`: there is something dark at two of its
/// corners or more.
[[nodiscard]] std::optional<MarkerCorners> read_tag(const GreyImage& image,
                                                    const std::array<Vec2, 4>& corners_px,
                                                    const apriltag_family& family, int max_hamming,
                                                    bool& touched);

}  // namespace orthonav::nav
