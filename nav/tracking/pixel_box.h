#pragma once

#include "base/image.h"

namespace orthonav::nav {

/// Whole pixels of an image.
struct PixelBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
};

/// The part of the box inside the image, widened to whole steps from the image's first pixel and by
/// one more step on every side as far as the image goes. Empty boxes may be returned with negative
/// sides.
[[nodiscard]] PixelBox in_whole_steps(const PixelBox& box, const GreyImage& image, int step_px);

}  // namespace orthonav::nav
