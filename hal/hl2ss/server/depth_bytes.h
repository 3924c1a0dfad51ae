#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "hal/api/depth_camera.h"

namespace orthonav::hl2ss {

/// A depth camera's answer in mode 2, written from the protocol's description: directions at the
/// pixels' corners, (0, 0) where it has none, millimetres as its unit; for AHaT also where it
/// wraps.
[[nodiscard]] std::vector<std::uint8_t> depth_answer_bytes(const DepthCalibration& camera);

/// A picture as the device holds it: nothing measured is 4095 for AHaT, 0 for long throw. Depth,
/// then brightness.
[[nodiscard]] std::vector<std::uint8_t> raw_depth_bytes(DepthStream stream,
                                                        const DepthFrame& frame);

/// One picture of AHaT as its encoder is given it: luma is a quarter of the depth in 8 bits, 0
/// where nothing was measured; the chroma planes together are the root of every other pair of
/// brightness.
struct PackedAhat {
  GreyImage luma;
  std::vector<std::uint8_t> chroma;
};
[[nodiscard]] PackedAhat packed_ahat(const DepthFrame& frame);

/// A long-throw picture as a PNG of 8-bit RGBA whose pixels in the order blue, green, red, alpha
/// are the bytes of `raw_depth_bytes`.
Result<std::vector<std::uint8_t>> long_throw_png(const DepthFrame& frame);

}  // namespace orthonav::hl2ss
