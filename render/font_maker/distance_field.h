#pragma once

#include <cstdint>
#include <vector>

namespace orthonav::font_maker {

/// A black and white picture, row-major, 1 inside the glyph.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> inside;
};

/// Signed distance of every cell's centre to the outline, in cells, positive inside. Exact
/// Euclidean (Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, 2012).
std::vector<float> signed_distance(const Mask& mask);

}  // namespace orthonav::font_maker
