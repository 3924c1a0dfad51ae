#pragma once

#include <algorithm>

#include "base/image.h"
#include "base/vec.h"

namespace orthonav::nav {

/// Grey value at any position, interpolated between pixel centres; outside the image, that of the
/// nearest edge. The image must be at least two pixels wide and high.
[[nodiscard]] inline double grey_at(const GreyImage& image, Vec2 place_px) {
  const double x = std::clamp(place_px.x - 0.5, 0.0, image.width_px - 1.0);
  const double y = std::clamp(place_px.y - 0.5, 0.0, image.height_px - 1.0);
  const int column = std::min(static_cast<int>(x), image.width_px - 2);
  const int row = std::min(static_cast<int>(y), image.height_px - 2);
  const double fx = x - column;
  const double fy = y - row;
  const double top = (1 - fx) * image.at(column, row) + fx * image.at(column + 1, row);
  const double bottom = (1 - fx) * image.at(column, row + 1) + fx * image.at(column + 1, row + 1);
  return (1 - fy) * top + fy * bottom;
}

}  // namespace orthonav::nav
