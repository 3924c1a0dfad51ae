#include "hal/hl2ss/server/depth_port.h"

#include <algorithm>
#include <utility>

#include "hal/hl2ss/server/depth_bytes.h"
#include "hal/hl2ss/server/packets.h"

namespace orthonav::hl2ss {
namespace {

/// A depth camera's sensor ticks are cycles of 24 MHz here; no client reads them.
constexpr std::int64_t kCyclesAMicrosecond = 24;
constexpr int kAhatFramesPerSecond = 45;

}  // namespace

bool DepthPort::is_streaming() const {
  const MutexLock lock(mutex_);
  return asked_.has_value();
}

Result<std::size_t> DepthPort::understand(Bytes said) {
  if (calibration_.empty()) {
    return Error{"this headset has no such camera"};
  }
  const auto asked = understand_depth_request(stream_, said);
  if (!asked) {
    return asked.error();
  }
  if (!*asked) {
    return std::size_t{0};
  }
  if ((*asked)->what == DepthAsked::What::kCalibration) {
    port_.send({Chunk{calibration_}});
  } else {
    const MutexLock lock(mutex_);
    asked_ = **asked;
    ++requests_;
  }
  return (*asked)->bytes;
}

Result<std::vector<std::uint8_t>> DepthPort::pictured(const DepthAsked& asked, std::int64_t request,
                                                      const DepthFrame& frame) {
  if (asked.coding != DepthCoding::kH264) {
    return asked.coding == DepthCoding::kPng ? long_throw_png(frame)
                                             : raw_depth_bytes(stream_, frame);
  }
  // A new client must get a key frame first.
  if (!encoder_ || encoded_request_ != request) {
    auto encoder = VideoEncoder::create({asked.bitrate, asked.gop_size, 1, frame.range_mm.width_px,
                                         frame.range_mm.height_px,
                                         std::max(1, kAhatFramesPerSecond / asked.every)});
    if (!encoder) {
      return encoder.error();
    }
    encoder_ = std::move(*encoder);
    encoded_request_ = request;
  }
  const PackedAhat packed = packed_ahat(frame);
  return encoder_->encode(packed.luma, &packed.chroma);
}

Status DepthPort::send(const DepthFrame& frame) {
  std::optional<DepthAsked> asked;
  std::int64_t request = 0;
  {
    const MutexLock lock(mutex_);
    asked = asked_;
    request = requests_;
  }
  if (!asked || pictures_++ % asked->every != 0) {
    return {};
  }
  const auto picture = pictured(*asked, request, frame);
  if (!picture) {
    return picture.error();
  }
  std::vector<std::uint8_t> payload;
  payload.reserve(picture->size() + 24);
  if (stream_ == DepthStream::kAhat) {
    append(payload, std::uint32_t{0});  // size of a separately coded depth
    append(payload, static_cast<std::uint32_t>(picture->size()));
  }
  payload.insert(payload.end(), picture->begin(), picture->end());
  append(payload, static_cast<std::uint64_t>(ticks_100ns(frame.time) / 10 * kCyclesAMicrosecond));
  auto packet = packet_bytes(ticks_100ns(frame.time), payload);
  if (asked->what == DepthAsked::What::kPicturesWithPoses) {
    append_pose(packet, frame.world_from_rig);
  }
  const MutexLock lock(mutex_);
  if (asked_ && requests_ == request) {
    port_.send({Chunk{std::move(packet)}});
  }
  return {};
}

}  // namespace orthonav::hl2ss
