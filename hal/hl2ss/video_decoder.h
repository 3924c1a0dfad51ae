#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {

/// Decodes access units to pictures, one in, one out, with libavcodec. Incompletely decoded
/// pictures are discarded: after damage nothing is returned until the next key frame. libavcodec
/// does not notice that a unit is missing; TCP loses none, and whoever drops one calls `restart`.
class VideoDecoder {
 public:
  /// For pictures of this size only. Both sides must be even.
  static Result<std::unique_ptr<VideoDecoder>> create(int width_px, int height_px);
  ~VideoDecoder();

  /// Decodes one access unit's luma into `image` and returns the number (`unit`) of the access unit
  /// that the picture belongs to; nothing if no picture came out. An Error names the damage; the
  /// decoder then waits for a key frame. `chroma`, if given, receives the two other planes one
  /// after the other, each half as wide and high, without padding.
  Result<std::optional<std::int64_t>> decode(Bytes access_unit, std::int64_t unit, GreyImage& image,
                                             std::vector<std::uint8_t>* chroma = nullptr);
  /// A part of the stream was lost: waits for a key frame.
  void restart();

 private:
  struct Codec;
  VideoDecoder(std::unique_ptr<Codec> codec, int width_px, int height_px);
  Result<std::optional<std::int64_t>> take_picture(GreyImage& image,
                                                   std::vector<std::uint8_t>* chroma);
  [[nodiscard]] Status check_picture(bool with_chroma) const;

  std::unique_ptr<Codec> codec_;
  int width_px_;
  int height_px_;
};

}  // namespace orthonav::hl2ss
