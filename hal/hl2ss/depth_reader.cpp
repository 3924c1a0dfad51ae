#include "hal/hl2ss/depth_reader.h"

#include <string>
#include <utility>

#include "hal/hl2ss/video.h"

namespace orthonav::hl2ss {
namespace {

std::string title_of(DepthStream stream) { return std::string("depth ") + name_of(stream); }

}  // namespace

DepthReader::DepthReader(const DepthWish& wish, std::uint32_t bitrate,
                         const DepthDescription& camera, const StampTeller& stamps,
                         ArrivalMeter& meter, DepthMailbox& pictures)
    : PacketPort(title_of(wish.stream), {format_of(wish.stream).max_payload(), true}),
      wish_(wish),
      format_(format_of(wish.stream)),
      bitrate_(bitrate),
      millimetres_(millimetres_of(camera)),
      stamps_(stamps),
      meter_(meter),
      pictures_(pictures) {}

Result<std::unique_ptr<DepthReader>> DepthReader::create(
    const DepthWish& wish, std::uint32_t bitrate, const DepthDescription& camera,
    const StampTeller& stamps, ArrivalMeter& meter, DepthMailbox& pictures) {
  auto reader =
      std::unique_ptr<DepthReader>(new DepthReader(wish, bitrate, camera, stamps, meter, pictures));
  const DepthFormat& format = reader->format_;
  if (wish.coding == DepthCoding::kH264) {
    auto decoder = VideoDecoder::create(format.width_px, format.height_px);
    if (!decoder) {
      return decoder.error();
    }
    reader->video_ = std::move(*decoder);
  } else if (wish.coding == DepthCoding::kPng) {
    auto decoder = PngDecoder::create(format.width_px, format.height_px);
    if (!decoder) {
      return decoder.error();
    }
    reader->png_ = std::move(*decoder);
  }
  return reader;
}

std::vector<std::uint8_t> DepthReader::opening() {
  if (video_) {
    video_->restart();
  }
  underway_.clear();
  return request_bytes(wish_, bitrate_);
}

void DepthReader::heard(const Packet& packet, HostTime at) {
  const auto time = stamps_.told(packet.ticks, at);
  if (!time) {
    if (video_) {
      video_->restart();
    }
    return meter_.refused(time.error().message);
  }
  meter_.heard(*time, at);
  if (const Status taken = take(packet, *time); !taken) {
    meter_.damaged(taken.error().message);
  }
}

Status DepthReader::take(const Packet& packet, Timestamp time) {
  const auto picture = split_depth(wish_.stream, packet.payload);
  if (!picture) {
    return picture.error();
  }
  if (!*picture) {
    return {};
  }
  // An invalid pose must not cost the picture.
  const auto pose = read_pose(packet.pose);
  picture_.time = time;
  picture_.world_from_rig = pose ? *pose : std::nullopt;
  if (const Status taken = take_picture(**picture); !taken) {
    return taken;
  }
  return pose ? Status() : pose.error();
}

Status DepthReader::take_picture(Bytes picture) {
  if (video_) {
    const auto decoded = take_video(picture);
    if (!decoded) {
      return decoded.error();
    }
    if (!*decoded) {
      return {};
    }
  } else if (const Status taken = png_ ? take_png(picture) : take_raw(picture); !taken) {
    return taken;
  }
  publish();
  return {};
}

Status DepthReader::take_raw(Bytes picture) {
  if (picture.size() != format_.raw_bytes()) {
    return Error{"raw picture of " + std::to_string(picture.size()) + " bytes, must be " +
                 std::to_string(format_.raw_bytes())};
  }
  read_raw_depth(format_, picture, picture_.range_mm, picture_.brightness);
  return {};
}

Status DepthReader::take_png(Bytes picture) {
  if (const Status decoded = png_->decode(picture, bytes_); !decoded) {
    return decoded;
  }
  return take_raw(bytes_);
}

Result<bool> DepthReader::take_video(Bytes picture) {
  const std::int64_t unit = underway_.add({picture_.time, picture_.world_from_rig});
  const auto decoded = video_->decode(picture, unit, luma_, &bytes_);
  if (!decoded) {
    return decoded.error();
  }
  const auto known = *decoded ? underway_.take(**decoded) : std::nullopt;
  if (!known) {
    return false;
  }
  picture_.time = known->time;
  picture_.world_from_rig = known->world_from_rig;
  read_coded_ahat(luma_, bytes_, picture_.range_mm, picture_.brightness);
  return true;
}

void DepthReader::publish() {
  for (std::uint16_t& value : picture_.range_mm.pixels) {
    value = millimetres_[value];
  }
  pictures_.put(picture_);
}

}  // namespace orthonav::hl2ss
