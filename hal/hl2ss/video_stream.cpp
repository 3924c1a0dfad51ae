#include "hal/hl2ss/video_stream.h"

#include <cstdlib>

namespace orthonav::hl2ss {
namespace {

// One picture coded again differs by what the codec leaves: at 12 Mbit/s no pixel by more than 9
// grey values, at 1 Mbit/s by 15. Where anything moves, edges do: with a head at rest and
// little noise 77 pixels and more change by over 12, with a head on a neck 230.
constexpr int kCodingNoiseGrey = 12;
constexpr std::size_t kMaxBeyond = 30;

bool is_coded_anew(const GreyImage& before, const GreyImage& now) {
  if (before.pixels.size() != now.pixels.size()) {
    return false;
  }
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < now.pixels.size(); ++i) {
    beyond += std::abs(now.pixels[i] - before.pixels[i]) > kCodingNoiseGrey ? 1U : 0U;
  }
  return beyond <= kMaxBeyond;
}

}  // namespace

std::vector<std::uint8_t> VideoStream::opening() {
  if (decoder_) {
    decoder_->restart();
  }
  underway_.clear();
  return request_bytes(request_);
}

void VideoStream::disconnected() {
  PacketStream::disconnected();
  stamps_.restart();
  sink_.lost(side_);
}

Status VideoStream::check_stamp(const Packet& packet, Timestamp stamp) {
  const auto payload = split_image(packet.payload);
  if (!payload) {
    return {};
  }
  const Status right = stamps_.check(stamp, payload->trailer.sensor_ticks);
  if (const auto leapt = stamps_.leapt()) {
    sink_.leapt(side_, *leapt);
  }
  return right;
}

void VideoStream::left_out() {
  if (decoder_) {
    decoder_->restart();
  }
}

Status VideoStream::take(const Packet& packet, const Stamped& stamped) {
  const auto payload = split_image(packet.payload);
  if (!payload) {
    return {};
  }
  // An invalid pose must not cost the image: the pair then states that the head is not located.
  const auto pose = read_pose(packet.pose);
  Status damage;
  if (!pose) {
    damage = pose.error();
  }
  const auto world_from_rig = pose ? *pose : std::nullopt;
  image_.arrived = stamped.at;
  if (!decoder_) {
    if (!stamped.is_trusted) {
      return {};
    }
    if (const Status taken = take_raw(payload->image); !taken) {
      return taken;
    }
    image_.sensor_ticks = payload->trailer.sensor_ticks;
    image_.time = stamped.time;
    image_.world_from_rig = world_from_rig;
    sink_.take(side_, image_);
    return damage;
  }
  const std::int64_t unit = underway_.add(
      {payload->trailer.sensor_ticks, stamped.time, world_from_rig, stamped.is_trusted});
  const auto decoded = take_h264(payload->image, unit);
  if (!decoded) {
    return decoded.error();
  }
  if (*decoded) {
    sink_.take(side_, image_);
  }
  return damage;
}

Status VideoStream::take_raw(Bytes picture) {
  if (picture.size() != kImageBytes) {
    return Error{"raw image of " + std::to_string(picture.size()) + " bytes, must be " +
                 std::to_string(kImageBytes)};
  }
  image_.image.width_px = kImageWidthPx;
  image_.image.height_px = kImageHeightPx;
  image_.image.pixels.assign(picture.begin(), picture.end());
  return {};
}

Result<bool> VideoStream::take_h264(Bytes access_unit, std::int64_t unit) {
  const auto decoded = decoder_->decode(access_unit, unit, image_.image);
  if (!decoded) {
    return decoded.error();
  }
  if (*decoded) {
    image_.repeats = is_coded_anew(last_picture_, image_.image);
    last_picture_.pixels.assign(image_.image.pixels.begin(), image_.image.pixels.end());
  }
  const auto known = *decoded ? underway_.take(**decoded) : std::nullopt;
  if (!known) {
    return false;
  }
  image_.sensor_ticks = known->sensor_ticks;
  image_.time = known->time;
  image_.world_from_rig = known->world_from_rig;
  // A picture with a wrong stamp is decoded, since later ones depend on it, but not used.
  return known->is_trusted;
}

}  // namespace orthonav::hl2ss
