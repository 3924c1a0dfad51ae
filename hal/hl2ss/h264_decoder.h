#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/h264_order.h"

namespace orthonav::hl2ss {

/// Pictures out of H.264 access units, one in, one out, by libavcodec. A picture that was decoded
/// with anything missing is no picture: after damage nothing comes until the next key frame.
class H264Decoder {
 public:
  /// Of this size; pictures of another are refused. Both sides must be even.
  static Result<std::unique_ptr<H264Decoder>> create(int width_px, int height_px);
  ~H264Decoder();

  /// Decodes one access unit's luma into `image` and answers which unit the picture belongs to, as
  /// it was numbered by `unit`; nothing when none came out. An Error names the damage; the decoder
  /// then waits for a key frame. `chroma`, if given, gets the two other planes one after the other,
  /// half as wide and high each, without padding.
  Result<std::optional<std::int64_t>> decode(Bytes access_unit, std::int64_t unit, GreyImage& image,
                                             std::vector<std::uint8_t>* chroma = nullptr);
  /// Something of the stream was lost: waits for a key frame.
  void restart();

 private:
  struct Codec;
  H264Decoder(std::unique_ptr<Codec> codec, int width_px, int height_px);
  Result<std::optional<std::int64_t>> take_picture(GreyImage& image,
                                                   std::vector<std::uint8_t>* chroma);
  [[nodiscard]] Status check_picture(bool with_chroma) const;

  std::unique_ptr<Codec> codec_;
  int width_px_;
  int height_px_;
  H264Order order_;
};

}  // namespace orthonav::hl2ss
