#pragma once

#include <array>

#include "base/image.h"
#include "base/vec.h"

namespace orthonav::nav {

/// The corners of a dark or bright square, moved to where its four edges meet. Each edge is the
/// line through the places of steepest grey on rays across it, weighted by the steepness; rays that
/// disagree with the others lose their weight (Tukey's biweight). Grey is interpolated, which on
/// rendered tags makes these lines twice as exact as with the library's own refinement. An edge
/// without enough agreeing rays stays as it was. Corners in continuous pixels, in either sense of
/// rotation.
[[nodiscard]] std::array<Vec2, 4> refined_corners(const GreyImage& image,
                                                  const std::array<Vec2, 4>& corners_px);

}  // namespace orthonav::nav
