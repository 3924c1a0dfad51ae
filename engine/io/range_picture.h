#pragma once

#include <cstdint>

#include "base/image.h"

namespace orthonav::engine {

/// A depth image to look at: white is nearest, dark grey farthest, black was not measured.
struct RangePicture {
  RgbaImage image;
  std::uint16_t white_mm =
      0;  ///< all but a hundredth of the pixels lie between these two, if any were measured
  std::uint16_t dark_mm = 0;
};
[[nodiscard]] RangePicture picture_of_ranges(const DepthImage& range_mm);

}  // namespace orthonav::engine
