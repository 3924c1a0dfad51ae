#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "base/image.h"
#include "base/result.h"
#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/h264_order.h"

namespace orthonav::hl2ss {

/// Pictures of a front camera out of H.264 access units, one in, one out, by libavcodec: its luma
/// is the image. A picture that was decoded with anything missing is no picture: after damage
/// nothing comes until the next key frame.
class H264Decoder {
 public:
  static Result<std::unique_ptr<H264Decoder>> create();
  ~H264Decoder();

  /// Decodes one access unit into `image` (640×480) and answers which unit the picture belongs to,
  /// as it was numbered by `unit`; nothing when none came out. An Error names the damage; the
  /// decoder then waits for a key frame.
  Result<std::optional<std::int64_t>> decode(Bytes access_unit, std::int64_t unit,
                                             GreyImage& image);
  /// Something of the stream was lost: waits for a key frame.
  void restart();

 private:
  struct Codec;
  explicit H264Decoder(std::unique_ptr<Codec> codec);
  Result<std::optional<std::int64_t>> take_picture(GreyImage& image);

  std::unique_ptr<Codec> codec_;
  H264Order order_;
};

}  // namespace orthonav::hl2ss
