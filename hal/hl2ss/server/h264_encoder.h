#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.h"
#include "base/result.h"

namespace orthonav::hl2ss {

/// Grey pictures of 640×480 to H.264 access units in Annex B, one in, one out, by libx264: the luma
/// is the picture. A key frame every second. The same pictures give the same bytes.
class H264Encoder {
 public:
  static Result<std::unique_ptr<H264Encoder>> create(std::uint32_t bitrate);
  ~H264Encoder();
  Result<std::vector<std::uint8_t>> encode(const GreyImage& image);

 private:
  struct Codec;
  explicit H264Encoder(std::unique_ptr<Codec> codec);
  std::unique_ptr<Codec> codec_;
};

}  // namespace orthonav::hl2ss
