#include "hal/hl2ss/server/video_encoder.h"

#include <algorithm>
#include <string>
#include <utility>

#include "hal/hl2ss/libav_codec.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}

namespace orthonav::hl2ss {
namespace {

constexpr std::uint8_t kNoColour = 128;

Error failed(const std::string& what, int code) {
  return Error{"H.264 encoder " + what + ": " + libav_reason(code)};
}

/// Without delay, one picture at a time, as the headset's own encoder does.
void describe_stream(const VideoEncoder::Options& options, AVCodecContext& context) {
  context.width = options.width_px;
  context.height = options.height_px;
  context.time_base = {1, options.frames_per_second};
  context.framerate = {options.frames_per_second, 1};
  context.pix_fmt = AV_PIX_FMT_YUV420P;
  context.color_range = AVCOL_RANGE_JPEG;
  context.gop_size = options.gop_size;
  context.slices = options.slices;
  context.max_b_frames = 0;
  context.thread_count = 1;
  context.bit_rate = std::int64_t{options.bitrate};
  context.log_level_offset = 64;  // prevents printing by the library
}

void fill_plane(const std::uint8_t* from, int width, int height, AVFrame& frame, int plane) {
  for (std::ptrdiff_t y = 0; y < height; ++y) {
    std::copy_n(from + y * width, width, frame.data[plane] + y * frame.linesize[plane]);
  }
}

}  // namespace

struct VideoEncoder::Codec : LibavCodec {
  std::int64_t frames = 0;

  Status open(const Options& options);
};

Status VideoEncoder::Codec::open(const Options& options) {
  const AVCodec* found = avcodec_find_encoder_by_name("libx264");
  if (found == nullptr) {
    return Error{"libavcodec has no H.264 encoder (libx264)"};
  }
  if (!allocate(found)) {
    return Error{"out of memory for the H.264 encoder"};
  }
  describe_stream(options, *context);
  for (const auto& [key, value] :
       {std::pair{"preset", "ultrafast"}, {"tune", "zerolatency"}, {"profile", "baseline"}}) {
    if (const int code = av_opt_set(context->priv_data, key, value, 0); code < 0) {
      return failed(key, code);
    }
  }
  if (const int code = avcodec_open2(context, found, nullptr); code < 0) {
    return failed("refused the settings", code);
  }
  frame->format = context->pix_fmt;
  frame->width = options.width_px;
  frame->height = options.height_px;
  frame->color_range = AVCOL_RANGE_JPEG;
  if (const int code = av_frame_get_buffer(frame, 0); code < 0) {
    return failed("no frame", code);
  }
  return {};
}

VideoEncoder::VideoEncoder(std::unique_ptr<Codec> codec) : codec_(std::move(codec)) {}
VideoEncoder::~VideoEncoder() = default;

Result<std::unique_ptr<VideoEncoder>> VideoEncoder::create(const Options& options) {
  auto codec = std::make_unique<Codec>();
  if (const Status opened = codec->open(options); !opened) {
    return opened.error();
  }
  return std::unique_ptr<VideoEncoder>(new VideoEncoder(std::move(codec)));
}

Result<std::vector<std::uint8_t>> VideoEncoder::encode(const GreyImage& luma,
                                                       const std::vector<std::uint8_t>* chroma) {
  Codec& codec = *codec_;
  const int width = codec.frame->width;
  const int height = codec.frame->height;
  const std::size_t quarter = luma.pixels.size() / 4;
  if (luma.width_px != width || luma.height_px != height ||
      (chroma && chroma->size() != 2 * quarter)) {
    return Error{"H.264 encoder: picture must be " + std::to_string(width) + "x" +
                 std::to_string(height)};
  }
  if (const int code = av_frame_make_writable(codec.frame); code < 0) {
    return failed("no frame", code);
  }
  fill_plane(luma.pixels.data(), width, height, *codec.frame, 0);
  for (const int plane : {1, 2}) {
    if (chroma) {
      fill_plane(chroma->data() + (plane == 1 ? 0 : quarter), width / 2, height / 2, *codec.frame,
                 plane);
    } else {
      std::fill_n(codec.frame->data[plane],
                  std::ptrdiff_t{codec.frame->linesize[plane]} * (height / 2), kNoColour);
    }
  }
  codec.frame->pts = codec.frames++;
  if (const int code = avcodec_send_frame(codec.context, codec.frame); code < 0) {
    return failed("took no picture", code);
  }
  const int code = avcodec_receive_packet(codec.context, codec.packet);
  if (code < 0) {
    return failed("gave no picture", code);
  }
  std::vector<std::uint8_t> bytes(codec.packet->data, codec.packet->data + codec.packet->size);
  av_packet_unref(codec.packet);
  return bytes;
}

}  // namespace orthonav::hl2ss
