#pragma once

#include <cstdint>

namespace orthonav::render {

// The embedded glyph atlas, as the build's font maker writes it: header, glyphs by rising code,
// then width × height distances, one byte a texel. Lengths are in cap heights, y up from the
// baseline; texture rectangles in texels, v down.

struct FontFileHeader {
  std::uint32_t glyphs = 0;
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  float reach = 0;  ///< distance to the outline at the bytes 0 and 255
};

struct FontFileGlyph {
  std::uint32_t code = 0;
  float advance = 0;
  float left = 0;
  float bottom = 0;
  float right = 0;
  float top = 0;
  std::uint16_t u0 = 0;
  std::uint16_t v0 = 0;
  std::uint16_t u1 = 0;
  std::uint16_t v1 = 0;
};

}  // namespace orthonav::render
