#include "hal/hl2ss/server/depth_bytes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "hal/hl2ss/bytes.h"
#include "hal/hl2ss/libav_codec.h"

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace orthonav::hl2ss {
namespace {

constexpr float kUnitsAMetre = 1000.0F;
constexpr std::uint16_t kAhatSaysNothing = 4095;
constexpr std::uint16_t kAhatNothingFrom = 4090;

/// Directions on the unit plane at the pixels' top-left corners, from those at the centres around
/// them; (0, 0) where one of these has none.
class Corners {
 public:
  explicit Corners(const DepthCalibration& camera) : camera_(camera) {}
  [[nodiscard]] Vec2 at(int x, int y) const {
    Vec2 sum{};
    // The first row and column have no pixel on the far side: they are extrapolated.
    for (const auto& [column, across] : beside(x)) {
      for (const auto& [row, down] : beside(y)) {
        const auto& ray =
            camera_
                .rays[static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.width_px) +
                      static_cast<std::size_t>(column)];
        if (ray[2] == 0.0F) {
          return {};
        }
        sum = sum + across * down * Vec2{ray[0] / ray[2], ray[1] / ray[2]};
      }
    }
    return sum;
  }

 private:
  static std::array<std::pair<int, double>, 2> beside(int at) {
    if (at == 0) {
      return {{{0, 1.5}, {1, -0.5}}};
    }
    return {{{at - 1, 0.5}, {at, 0.5}}};
  }
  const DepthCalibration& camera_;
};

struct PngEncoder : LibavCodec {
  Status open(int width, int height) {
    const AVCodec* png = avcodec_find_encoder(AV_CODEC_ID_PNG);
    if (!allocate(png)) {
      return Error{"PNG encoder: libavcodec has none, or memory is short"};
    }
    context->width = frame->width = width;
    context->height = frame->height = height;
    context->pix_fmt = AV_PIX_FMT_RGBA;
    frame->format = AV_PIX_FMT_RGBA;
    context->time_base = {1, 5};
    context->log_level_offset = 64;  // prevents printing by the library
    if (avcodec_open2(context, png, nullptr) < 0 || av_frame_get_buffer(frame, 0) < 0) {
      return Error{"PNG encoder: refused " + std::to_string(width) + "x" + std::to_string(height)};
    }
    return {};
  }
};

}  // namespace

std::vector<std::uint8_t> depth_answer_bytes(const DepthCalibration& camera) {
  std::vector<std::uint8_t> bytes;
  const Corners corners(camera);
  for (const int axis : {0, 1}) {
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const Vec2 corner = corners.at(x, y);
        append(bytes, static_cast<float>(axis == 0 ? corner.x : corner.y));
      }
    }
  }
  const auto columns = camera.sensor_from_rig.row_major();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    append(bytes, static_cast<float>(columns[4 * (i % 4) + i / 4]));
  }
  append(bytes, kUnitsAMetre);
  if (camera.stream == DepthStream::kAhat) {
    append(bytes, static_cast<float>(camera.wraps_at_m) * kUnitsAMetre);
  }
  // Maps and focal lengths of the undistorted image: zeros, which our clients do not read.
  bytes.resize(bytes.size() + sizeof(float) * (2 * camera.rays.size() + 4));
  return bytes;
}

std::vector<std::uint8_t> raw_depth_bytes(DepthStream stream, const DepthFrame& frame) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * frame.range_mm.pixels.size());
  const std::uint16_t nothing = stream == DepthStream::kAhat ? kAhatSaysNothing : std::uint16_t{0};
  for (const std::uint16_t mm : frame.range_mm.pixels) {
    append(bytes, mm == 0 ? nothing : mm);
  }
  for (std::size_t i = 0; i < frame.range_mm.pixels.size(); ++i) {
    append(bytes, frame.brightness.pixels.empty() ? std::uint16_t{0} : frame.brightness.pixels[i]);
  }
  return bytes;
}

PackedAhat packed_ahat(const DepthFrame& frame) {
  const auto& depth = frame.range_mm;
  PackedAhat packed{GreyImage(depth.width_px, depth.height_px), {}};
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const unsigned mm = depth.pixels[i] < kAhatNothingFrom ? depth.pixels[i] : 0U;
    packed.luma.pixels[i] = static_cast<std::uint8_t>(mm / 4U);
  }
  const auto root = [&](std::size_t i) {
    const double light = frame.brightness.pixels.empty() ? 0.0 : frame.brightness.pixels[i];
    return static_cast<std::uint8_t>(std::sqrt(light));
  };
  for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
    for (std::size_t i = first; i < depth.pixels.size(); i += 4) {
      packed.chroma.push_back(root(i));
    }
  }
  return packed;
}

Result<std::vector<std::uint8_t>> long_throw_png(const DepthFrame& frame) {
  const int width = frame.range_mm.width_px;
  const int height = frame.range_mm.height_px;
  const auto bgra = raw_depth_bytes(DepthStream::kLongThrow, frame);
  PngEncoder encoder;
  if (const Status opened = encoder.open(width, height); !opened) {
    return opened.error();
  }
  for (int y = 0; y < height; ++y) {
    std::uint8_t* row = encoder.frame->data[0] + std::ptrdiff_t{y} * encoder.frame->linesize[0];
    const std::uint8_t* from = bgra.data() + std::ptrdiff_t{4} * width * y;
    for (int x = 0; x < 4 * width; x += 4) {
      row[x] = from[x + 2];
      row[x + 1] = from[x + 1];
      row[x + 2] = from[x];
      row[x + 3] = from[x + 3];
    }
  }
  if (avcodec_send_frame(encoder.context, encoder.frame) < 0 ||
      avcodec_receive_packet(encoder.context, encoder.packet) < 0) {
    return Error{"PNG encoder: gave no picture"};
  }
  return std::vector<std::uint8_t>(encoder.packet->data,
                                   encoder.packet->data + encoder.packet->size);
}

}  // namespace orthonav::hl2ss
