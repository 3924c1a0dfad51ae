#include "hal/hl2ss/depth_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "hal/hl2ss/video.h"

namespace orthonav::hl2ss {
namespace {

/// A decoder without delay holds none; more are the past of a damaged stream.
constexpr std::size_t kMostUnitsHeld = 8;

std::string title_of(DepthStream stream) { return std::string("depth ") + name_of(stream); }

}  // namespace

DepthReader::DepthReader(const DepthWish& wish, std::uint32_t bitrate,
                         const DepthDescription& camera, const StampTeller& stamps,
                         ArrivalMeter& meter, DepthMailbox& pictures)
    : wish_(wish),
      format_(format_of(wish.stream)),
      bitrate_(bitrate),
      millimetres_(millimetres_of(camera)),
      stamps_(stamps),
      meter_(meter),
      pictures_(pictures),
      assembler_(title_of(wish.stream), {format_.max_payload(), true}) {}

Result<std::unique_ptr<DepthReader>> DepthReader::create(
    const DepthWish& wish, std::uint32_t bitrate, const DepthDescription& camera,
    const StampTeller& stamps, ArrivalMeter& meter, DepthMailbox& pictures) {
  auto reader =
      std::unique_ptr<DepthReader>(new DepthReader(wish, bitrate, camera, stamps, meter, pictures));
  const DepthFormat& format = reader->format_;
  if (wish.coded && wish.stream == DepthStream::kAhat) {
    auto decoder = H264Decoder::create(format.width_px, format.height_px);
    if (!decoder) {
      return decoder.error();
    }
    reader->h264_ = std::move(*decoder);
  } else if (wish.coded) {
    auto decoder = PngDecoder::create(format.width_px, format.height_px);
    if (!decoder) {
      return decoder.error();
    }
    reader->png_ = std::move(*decoder);
  }
  return reader;
}

std::vector<std::uint8_t> DepthReader::opening() {
  if (h264_) {
    h264_->restart();
  }
  underway_.clear();
  return request_bytes(wish_, bitrate_);
}

Status DepthReader::received(std::size_t count, HostTime at) {
  assembler_.received(count);
  for (;;) {
    const auto packet = assembler_.next();
    if (!packet) {
      return packet.error();
    }
    if (!*packet) {
      return {};
    }
    const auto time = stamps_.told((*packet)->ticks, at);
    if (!time) {
      meter_.refused(time.error().message);
      continue;
    }
    meter_.heard(*time, at);
    if (const Status taken = take(**packet, *time); !taken) {
      meter_.damaged(taken.error().message);
    }
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
  // A pose that is none must not cost the picture.
  const auto pose = read_pose(packet.pose);
  picture_.time = time;
  picture_.world_from_rig = pose ? *pose : std::nullopt;
  if (const Status taken = take_picture(**picture); !taken) {
    return taken;
  }
  return pose ? Status() : pose.error();
}

Status DepthReader::take_picture(Bytes picture) {
  if (h264_) {
    const auto decoded = take_h264(picture);
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

Result<bool> DepthReader::take_h264(Bytes picture) {
  if (underway_.size() == kMostUnitsHeld) {
    underway_.pop_front();
  }
  underway_.push_back({units_++, picture_.time, picture_.world_from_rig});
  const auto unit = h264_->decode(picture, underway_.back().unit, luma_, &bytes_);
  if (!unit) {
    return unit.error();
  }
  const auto known = std::find_if(underway_.begin(), underway_.end(), [&](const Underway& each) {
    return *unit && each.unit == **unit;
  });
  if (known == underway_.end()) {
    return false;
  }
  picture_.time = known->time;
  picture_.world_from_rig = known->world_from_rig;
  underway_.erase(underway_.begin(), known + 1);
  read_coded_ahat(luma_, bytes_, picture_.range_mm, picture_.brightness);
  return true;
}

void DepthReader::publish() {
  if (published_ && picture_.time <= *published_) {
    return;  // out of order; the meter counts it
  }
  published_ = picture_.time;
  for (std::uint16_t& value : picture_.range_mm.pixels) {
    value = millimetres_[value];
  }
  pictures_.put(picture_);
}

}  // namespace orthonav::hl2ss
