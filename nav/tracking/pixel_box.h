#pragma once

namespace orthonav::nav {

/// Whole pixels of an image.
struct PixelBox {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
};

}  // namespace orthonav::nav
