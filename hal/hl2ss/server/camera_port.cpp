#include "hal/hl2ss/server/camera_port.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "hal/api/research_mode.h"
#include "hal/hl2ss/server/packets.h"

namespace orthonav::hl2ss {
namespace {

/// The largest distance between key frames that an encoder accepts.
constexpr std::uint64_t kMaxGopSize = 3000;
constexpr Duration kStall = std::chrono::milliseconds(300);
constexpr Duration kHalfPause = std::chrono::milliseconds(40);

/// What is added to the time of an image, in ticks of 100 ns.
std::int64_t stamp_off_ticks(const VideoOptions& options) {
  const double exposures_s = options.stamp_exposures * 1e-9 * CameraPort::kExposureNs;
  // Implausible values are ignored.
  const Duration exposures =
      std::abs(exposures_s) <= 1.0 ? from_seconds(exposures_s) : Duration::zero();
  constexpr std::int64_t kSecondTicks = 10'000'000;
  const bool is_meant =
      options.stamp_offset_ticks >= -kSecondTicks && options.stamp_offset_ticks <= kSecondTicks;
  return (kResearchModeStampsLate + exposures) / Duration(100) +
         (is_meant ? options.stamp_offset_ticks : 0);
}

void overwrite(std::vector<std::uint8_t>& bytes, std::size_t at, Number auto value) {
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

}  // namespace

bool CameraPort::is_streaming() const {
  const MutexLock lock(mutex_);
  return request_.has_value();
}

Result<std::size_t> CameraPort::understand(Bytes said) {
  const auto read = read_video_request(said);
  if (!read) {
    return read.error();
  }
  if (!*read) {
    return std::size_t{0};
  }
  if ((*read)->request.mode == Mode::kCalibration) {
    port_.send({Chunk{calibration_}});
  } else {
    const MutexLock lock(mutex_);
    request_ = (*read)->request;
    ++stream_;
  }
  return (*read)->bytes;
}

Result<std::vector<std::uint8_t>> CameraPort::pictured(const VideoRequest& request,
                                                       std::int64_t stream,
                                                       const GreyImage& picture) {
  if (request.profile == VideoProfile::kRaw) {
    return picture.pixels;
  }
  // A new client must get a key frame first.
  if (!encoder_ || encoded_stream_ != stream) {
    auto encoder = VideoEncoder::create(
        {request.bitrate,
         static_cast<int>(std::clamp(request.options.value_or(VideoOptions{}).gop_size,
                                     std::uint64_t{1}, kMaxGopSize)),
         slices_});
    if (!encoder) {
      return encoder.error();
    }
    encoder_ = std::move(*encoder);
    encoded_stream_ = stream;
  }
  return encoder_->encode(picture);
}

Result<bool> CameraPort::send(const Image& image) {
  std::optional<VideoRequest> request;
  std::int64_t stream = 0;
  {
    const MutexLock lock(mutex_);
    request = request_;
    stream = stream_;
  }
  if (!request || images_++ % request->divisor != 0) {
    return false;
  }
  // Before the encoder: TCP loses no picture that others depend on.
  if (image.spoil && strikes(faults_.lose)) {
    return false;
  }
  const auto picture = pictured(*request, stream, *image.picture);
  if (!picture) {
    return picture.error();
  }
  const std::int64_t off_ticks = stamp_off_ticks(request->options.value_or(VideoOptions{}));
  auto packet =
      image_packet(image.ticks + off_ticks, *picture, {image.sensor_ticks, kExposureNs, 100});
  if (request->mode == Mode::kVideoAndPose) {
    append_pose(packet, image.world_from_rig_after(off_ticks * Duration(100)));
  }
  std::vector<Chunk> chunks;
  const Fate fate = image.spoil ? spoil(packet, chunks) : Fate::kUntouched;
  if (fate == Fate::kUntouched) {
    chunks.push_back({std::move(packet)});
  }
  const MutexLock lock(mutex_);
  if (!request_ || stream_ != stream) {
    return false;  // another client may be there, which waits for a calibration
  }
  port_.send(std::move(chunks));
  return fate != Fate::kBroken;
}

bool CameraPort::strikes(double probability) {
  const bool strike = random_.uniform() < probability;
  faults_done_ += strike ? 1 : 0;
  return strike;
}

/// The fate of a packet; unless it is untouched, `chunks` is sent instead.
CameraPort::Fate CameraPort::spoil(std::vector<std::uint8_t>& packet, std::vector<Chunk>& chunks) {
  const auto half = packet.begin() + static_cast<std::ptrdiff_t>(packet.size() / 2);
  if (strikes(faults_.stall)) {
    chunks.push_back({std::move(packet), kStall});
    return Fate::kLate;
  }
  if (strikes(faults_.half)) {
    chunks.push_back({{packet.begin(), half}, kHalfPause});
    chunks.push_back({{half, packet.end()}});
    return Fate::kLate;
  }
  if (strikes(faults_.cut)) {
    chunks.push_back({{packet.begin(), half}, {}, true});
    return Fate::kBroken;
  }
  if (strikes(faults_.misstamp)) {
    constexpr std::uint64_t kTenthTicks = 1'000'000;
    const auto stamp = number_at<std::uint64_t>(packet, 0);
    overwrite(packet, 0, random_.next() % 2 == 0 ? stamp - kTenthTicks : stamp + 10 * kTenthTicks);
    chunks.push_back({std::move(packet)});
    return Fate::kBroken;
  }
  if (!strikes(faults_.corrupt)) {
    return Fate::kUntouched;
  }
  corrupt(packet);
  chunks.push_back({std::move(packet)});
  return Fate::kBroken;
}

void CameraPort::corrupt(std::vector<std::uint8_t>& packet) {
  constexpr std::size_t kSizeAt = 8;
  const std::size_t pose_at = packet.size() - kPoseBytes;
  switch (random_.next() % 6) {
    case 0:
      return overwrite(packet, pose_at + 12 * 4, std::numeric_limits<float>::quiet_NaN());
    case 1:
      return overwrite(packet, kSizeAt, std::numeric_limits<std::uint32_t>::max());
    case 2: {  // an image that lacks a row, in a complete packet
      packet.erase(packet.begin() + kPacketHeaderBytes,
                   packet.begin() + kPacketHeaderBytes +
                       std::min<std::ptrdiff_t>(
                           640, static_cast<std::ptrdiff_t>(pose_at - kPacketHeaderBytes)));
      const std::size_t rest = packet.size() - kPacketHeaderBytes - kPoseBytes;
      return overwrite(packet, kSizeAt, static_cast<std::uint32_t>(rest));
    }
    case 3:
      return overwrite(packet, 0, random_.next());
    case 4:  // an hour back
      return overwrite(packet, 0, number_at<std::uint64_t>(packet, 0) - 36'000'000'000u);
    default:  // noise in the trailer and the pose
      for (std::size_t at = pose_at - kImageTrailerBytes; at < packet.size(); ++at) {
        packet[at] = static_cast<std::uint8_t>(random_.next());
      }
  }
}

}  // namespace orthonav::hl2ss
