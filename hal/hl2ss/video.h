#pragma once

#include <optional>

#include "base/result.h"
#include "base/transform.h"
#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {

/// Options requested in addition to the picture's format.
struct VideoOptions {
  std::uint64_t gop_size = 30;  ///< pictures from one key frame to the next
  double stamp_exposures = 0.0;
  std::int64_t stamp_offset_ticks = 0;  ///< of 100 ns
};

/// The request to a front camera.
struct VideoRequest {
  Mode mode = Mode::kVideoAndPose;
  std::uint8_t divisor = 1;  ///< one of this many frames is sent
  VideoProfile profile = VideoProfile::kRaw;
  std::uint32_t bitrate = 1;              ///< bit/s; meaningless for raw images, but must not be 0
  std::optional<VideoOptions> options{};  ///< all of them are sent, or none
};
/// The request as bytes.
[[nodiscard]] std::vector<std::uint8_t> request_bytes(const VideoRequest& request);

/// A request as parsed by a server, with its size in bytes; nothing while bytes are missing. HEVC,
/// unknown profiles or modes, and a divisor or bitrate of 0 are errors; options with unknown keys
/// are ignored.
struct ReadVideoRequest {
  VideoRequest request;
  std::size_t bytes = 0;
};
Result<std::optional<ReadVideoRequest>> read_video_request(Bytes bytes);

/// The data after an image.
struct ImageTrailer {
  std::uint64_t sensor_ticks = 0;  ///< the same for left and right
  std::uint64_t exposure_ns = 0;
  std::uint32_t gain = 0;
};

/// A payload split in two; `image` is one raw picture or one access unit of a codec.
struct ImagePayload {
  Bytes image;
  ImageTrailer trailer;
};
/// Nothing for a payload without an image (up to 24 bytes), which is not a fault.
[[nodiscard]] std::optional<ImagePayload> split_image(Bytes payload);

/// world_from_rig of a packet: 16 float32, row-major for row vectors. Nothing while the headset is
/// not located (last element 0); an Error if it is neither that nor a rigid motion.
Result<std::optional<Transform<World, Rig>>> read_pose(Bytes pose);
void append_pose(std::vector<std::uint8_t>& bytes,
                 const std::optional<Transform<World, Rig>>& world_from_rig);

}  // namespace orthonav::hl2ss
