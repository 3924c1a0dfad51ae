#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {

/// Encodes pictures as access units in Annex B, one in, one out, with libx264. The same
/// pictures give the same bytes.
class VideoEncoder {
 public:
  struct Options {
    std::uint32_t bitrate = 12'000'000;
    int gop_size = 30;  ///< pictures from one key frame to the next
    int slices = 1;     ///< of each picture
    int width_px = 640;
    int height_px = 480;
    int frames_per_second = 30;
  };
  static Result<std::unique_ptr<VideoEncoder>> create(const Options& options);
  ~VideoEncoder();
  /// `chroma`: the two other planes one after the other, each half as wide and high; empty: grey.
  Result<std::vector<std::uint8_t>> encode(const GreyImage& luma,
                                           const std::vector<std::uint8_t>* chroma = nullptr);

 private:
  struct Codec;
  explicit VideoEncoder(std::unique_ptr<Codec> codec);
  std::unique_ptr<Codec> codec_;
};

}  // namespace orthonav::hl2ss
