#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/result.h"
#include "hal/api/depth_camera.h"
#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/options.h"
#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {

/// The fixed properties of a depth stream.
struct DepthFormat {
  Service service = Service::kAhat;
  int width_px = 0;
  int height_px = 0;
  Duration interval{};  ///< nominally
  bool wraps = false;   ///< its calibration says where

  [[nodiscard]] constexpr std::size_t pixels() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  }
  /// Two numbers of 16 bits for each pixel: depth and brightness.
  [[nodiscard]] constexpr std::size_t raw_bytes() const { return 4 * pixels(); }
  /// The largest payload: no coding takes more than the picture itself.
  [[nodiscard]] constexpr std::size_t max_payload() const { return raw_bytes() + 16; }
};
/// `stream`: AHaT, or long throw.
[[nodiscard]] DepthFormat format_of(DepthStream stream);

/// The bytes of a request for the stream with poses.
[[nodiscard]] std::vector<std::uint8_t> request_bytes(const DepthWish& wish, std::uint32_t bitrate);

/// The picture in a payload, raw or coded. Nothing if the packet carries none, which is not a
/// fault; an Error for contradictory sizes and for a coding other than the one requested.
Result<std::optional<Bytes>> split_depth(DepthStream stream, Bytes payload);

/// Two images out of `raw_bytes`, in the device's units.
void read_raw_depth(const DepthFormat& format, Bytes raw, DepthImage& depth,
                    DepthImage& brightness);

/// The same from a coded picture of AHaT. `luma` is a quarter of the depth, its low 8 bits;
/// `chroma`, one plane behind the other, holds square roots of brightness, each of two pixels. The
/// depth becomes the middle of the four values that a luma value stands for, and 0 (not measured)
/// below 64: beyond 1,023 the luma starts again at 0, and nothing nearer than 64 is measured.
void read_coded_ahat(const GreyImage& luma, const std::vector<std::uint8_t>& chroma,
                     DepthImage& depth, DepthImage& brightness);

}  // namespace orthonav::hl2ss
