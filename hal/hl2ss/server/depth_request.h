#pragma once

#include <cstdint>
#include <optional>

#include "base/result.h"
#include "hal/api/depth_camera.h"
#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {

/// A client's request to a depth port, as the server parses it: written from the protocol's
/// description, not from what our own client sends.
struct DepthAsked {
  enum class What : std::uint8_t { kPictures, kPicturesWithPoses, kCalibration };
  What what = What::kPicturesWithPoses;
  int every = 1;  ///< one of this many pictures is sent
  DepthCoding coding = DepthCoding::kRaw;
  std::uint32_t bitrate = 1;
  int gop_size = 45;
  std::size_t bytes = 0;  ///< of the request
};

/// Nothing while bytes are missing; an Error for an invalid request, and for Zdepth, which this
/// server can't encode.
Result<std::optional<DepthAsked>> understand_depth_request(DepthStream stream, Bytes said);

}  // namespace orthonav::hl2ss
