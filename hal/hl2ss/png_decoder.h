#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// Decodes PNG files of one size with 8-bit RGBA, with libavcodec. Each is independent.
class PngDecoder {
 public:
  static Result<std::unique_ptr<PngDecoder>> create(int width_px, int height_px);
  ~PngDecoder();
  /// The pixels as blue, green, red, alpha, row-major without padding. An Error for damage, another
  /// size, another kind of pixels.
  Status decode(Bytes png, std::vector<std::uint8_t>& bgra);

 private:
  struct Codec;
  PngDecoder(std::unique_ptr<Codec> codec, int width_px, int height_px);

  std::unique_ptr<Codec> codec_;
  int width_px_;
  int height_px_;
};

}  // namespace orthonav::hl2ss
