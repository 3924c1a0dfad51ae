#include "hal/hl2ss/video_decoder.h"

#include <algorithm>
#include <string>

#include "hal/hl2ss/libav_codec.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/log.h>
}

namespace orthonav::hl2ss {
namespace {

bool has_plain_luma(int format) {
  return format == AV_PIX_FMT_YUV420P || format == AV_PIX_FMT_YUVJ420P ||
         format == AV_PIX_FMT_NV12 || format == AV_PIX_FMT_GRAY8;
}

bool has_plain_chroma(int format) {
  return format == AV_PIX_FMT_YUV420P || format == AV_PIX_FMT_YUVJ420P;
}

void append_plane(const std::uint8_t* rows, std::ptrdiff_t stride, int width, int height,
                  std::vector<std::uint8_t>& bytes) {
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* row = rows + y * stride;
    bytes.insert(bytes.end(), row, row + width);
  }
}

Error failed(const std::string& what) { return Error{"H.264" + what}; }

}  // namespace

struct VideoDecoder::Codec : LibavCodec {
  bool waits_for_key = true;
};

VideoDecoder::VideoDecoder(std::unique_ptr<Codec> codec, int width_px, int height_px)
    : codec_(std::move(codec)), width_px_(width_px), height_px_(height_px) {}
VideoDecoder::~VideoDecoder() = default;

Result<std::unique_ptr<VideoDecoder>> VideoDecoder::create(int width_px, int height_px) {
  const AVCodec* found = avcodec_find_decoder(AV_CODEC_ID_H264);
  if (found == nullptr) {
    return Error{"libavcodec has no H.264 decoder"};
  }
  auto codec = std::make_unique<Codec>();
  if (!codec->allocate(found)) {
    return Error{"out of memory for the H.264 decoder"};
  }
  // Threads would delay pictures; damage must be reported, never concealed.
  codec->context->thread_count = 1;
  codec->context->flags |= AV_CODEC_FLAG_LOW_DELAY;
  codec->context->err_recognition = AV_EF_EXPLODE | AV_EF_BITSTREAM | AV_EF_BUFFER;
  // Concealment stays on, and concealed pictures are refused by their flag (`take_picture`):
  // libavcodec 5.1 keeps its table of complete macroblocks only for concealment, and without it
  // reports every H.264 picture with several slices as damaged. Prevents printing by the library;
  // errors are returned as codes.
  codec->context->log_level_offset = AV_LOG_MAX_OFFSET;
  if (const int code = avcodec_open2(codec->context, found, nullptr); code < 0) {
    return failed(" decoder: " + libav_reason(code));
  }
  return std::unique_ptr<VideoDecoder>(new VideoDecoder(std::move(codec), width_px, height_px));
}

void VideoDecoder::restart() {
  avcodec_flush_buffers(codec_->context);
  codec_->waits_for_key = true;
}

Result<std::optional<std::int64_t>> VideoDecoder::decode(Bytes access_unit, std::int64_t unit,
                                                         GreyImage& image,
                                                         std::vector<std::uint8_t>* chroma) {
  Codec& codec = *codec_;
  if (const int code = av_new_packet(codec.packet, static_cast<int>(access_unit.size()));
      code < 0) {
    return failed(" decoder: " + libav_reason(code));
  }
  std::copy(access_unit.begin(), access_unit.end(), codec.packet->data);
  codec.packet->pts = unit;
  const int sent = avcodec_send_packet(codec.context, codec.packet);
  av_packet_unref(codec.packet);
  if (sent < 0) {
    restart();
    return failed(" picture is damaged: " + libav_reason(sent));
  }
  auto picture = take_picture(image, chroma);
  // The units after one whose picture could not be read would be decoded without it, wrongly.
  if (picture && !*picture && !codec.waits_for_key) {
    picture = failed(" unit holds no picture");
  }
  if (!picture) {
    restart();
  }
  return picture;
}

Status VideoDecoder::check_picture(bool with_chroma) const {
  const AVFrame& frame = *codec_->frame;
  if (frame.width != width_px_ || frame.height != height_px_) {
    return failed(" picture is " + std::to_string(frame.width) + "x" +
                  std::to_string(frame.height) + " px, must be " + std::to_string(width_px_) + "x" +
                  std::to_string(height_px_));
  }
  if (with_chroma ? !has_plain_chroma(frame.format) : !has_plain_luma(frame.format)) {
    return failed(" picture has pixel format " + std::to_string(frame.format) +
                  ", must be 8-bit 4:2:0");
  }
  return {};
}

Result<std::optional<std::int64_t>> VideoDecoder::take_picture(GreyImage& image,
                                                               std::vector<std::uint8_t>* chroma) {
  Codec& codec = *codec_;
  AVFrame* frame = codec.frame;
  const int code = avcodec_receive_frame(codec.context, frame);
  if (code == AVERROR(EAGAIN)) {
    return std::optional<std::int64_t>{};
  }
  if (code < 0) {
    return failed(" picture is damaged: " + libav_reason(code));
  }
  if (frame->key_frame != 0) {
    codec.waits_for_key = false;
  }
  if (frame->decode_error_flags != 0 || (frame->flags & AV_FRAME_FLAG_CORRUPT) != 0) {
    return failed(" picture is damaged");
  }
  if (codec.waits_for_key) {
    return std::optional<std::int64_t>{};
  }
  if (Status fits = check_picture(chroma != nullptr); !fits) {
    return fits.error();
  }
  image.width_px = width_px_;
  image.height_px = height_px_;
  image.pixels.clear();
  append_plane(frame->data[0], frame->linesize[0], width_px_, height_px_, image.pixels);
  if (chroma) {
    chroma->clear();
    for (const int plane : {1, 2}) {
      append_plane(frame->data[plane], frame->linesize[plane], width_px_ / 2, height_px_ / 2,
                   *chroma);
    }
  }
  return std::optional<std::int64_t>{frame->pts};
}

}  // namespace orthonav::hl2ss
