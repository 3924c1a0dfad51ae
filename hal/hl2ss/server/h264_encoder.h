#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.h"
#include "base/result.h"

namespace orthonav::hl2ss {

/// Grey pictures of 640×480 to H.264 access units in Annex B, one in, one out, by libx264: the luma
/// is the picture. The same pictures give the same bytes.
class H264Encoder {
 public:
  struct Options {
    std::uint32_t bitrate = 12'000'000;
    int gop_size = 30;  ///< pictures from one key frame to the next
    int slices = 1;     ///< of each picture
  };
  static Result<std::unique_ptr<H264Encoder>> create(const Options& options);
  ~H264Encoder();
  Result<std::vector<std::uint8_t>> encode(const GreyImage& image);

 private:
  struct Codec;
  explicit H264Encoder(std::unique_ptr<Codec> codec);
  std::unique_ptr<Codec> codec_;
};

}  // namespace orthonav::hl2ss
