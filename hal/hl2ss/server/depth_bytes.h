#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "hal/api/depth_camera.h"

namespace orthonav::hl2ss {

/// A depth camera's answer in mode 2, written from the protocol's description: directions at the
/// pixels' corners, (0, 0) for none, units of millimetres; for AHaT also the distance at which it
/// wraps.
[[nodiscard]] std::vector<std::uint8_t> depth_answer_bytes(const DepthCalibration& camera);

/// A picture as the device stores it: depth, then brightness. Unmeasured depth is 4095 for AHaT, 0
/// for long throw.
[[nodiscard]] std::vector<std::uint8_t> raw_depth_bytes(DepthStream stream,
                                                        const DepthFrame& frame);

/// One AHaT picture as given to the encoder: luma is a quarter of the depth in 8 bits, 0 where
/// nothing was measured; the chroma planes together hold the square root of every other pair of
/// brightness values.
struct PackedAhat {
  GreyImage luma;
  std::vector<std::uint8_t> chroma;
};
[[nodiscard]] PackedAhat packed_ahat(const DepthFrame& frame);

/// A long-throw picture as a PNG of 8-bit RGBA whose pixels in the order blue, green, red, alpha
/// are the bytes of `raw_depth_bytes`.
Result<std::vector<std::uint8_t>> long_throw_png(const DepthFrame& frame);

}  // namespace orthonav::hl2ss
