#include "hal/hl2ss/png_decoder.h"

#include <algorithm>
#include <string>
#include <utility>

#include "hal/hl2ss/libav_codec.h"

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace orthonav::hl2ss {

struct PngDecoder::Codec : LibavCodec {};

PngDecoder::PngDecoder(std::unique_ptr<Codec> codec, int width_px, int height_px)
    : codec_(std::move(codec)), width_px_(width_px), height_px_(height_px) {}
PngDecoder::~PngDecoder() = default;

Result<std::unique_ptr<PngDecoder>> PngDecoder::create(int width_px, int height_px) {
  const AVCodec* png = avcodec_find_decoder(AV_CODEC_ID_PNG);
  if (png == nullptr) {
    return Error{"libavcodec has no PNG decoder"};
  }
  auto codec = std::make_unique<Codec>();
  if (!codec->allocate(png)) {
    return Error{"out of memory for the PNG decoder"};
  }
  codec->context->thread_count = 1;
  codec->context->err_recognition = AV_EF_EXPLODE | AV_EF_CRCCHECK;
  // A picture that claims to be larger is refused before memory is allocated.
  codec->context->max_pixels = std::int64_t{width_px} * height_px;
  codec->context->log_level_offset = 64;  // prevents printing by the library
  if (const int code = avcodec_open2(codec->context, png, nullptr); code < 0) {
    return Error{"PNG decoder: " + libav_reason(code)};
  }
  return std::unique_ptr<PngDecoder>(new PngDecoder(std::move(codec), width_px, height_px));
}

Status PngDecoder::decode(Bytes png, std::vector<std::uint8_t>& bgra) {
  Codec& codec = *codec_;
  avcodec_flush_buffers(codec.context);
  if (const int code = av_new_packet(codec.packet, static_cast<int>(png.size())); code < 0) {
    return Error{"PNG decoder: " + libav_reason(code)};
  }
  std::copy(png.begin(), png.end(), codec.packet->data);
  // Without this libavcodec adds the picture to the one before it.
  codec.packet->flags |= AV_PKT_FLAG_KEY;
  int code = avcodec_send_packet(codec.context, codec.packet);
  av_packet_unref(codec.packet);
  if (code >= 0) {
    code = avcodec_receive_frame(codec.context, codec.frame);
  }
  if (code < 0) {
    return Error{"PNG is damaged: " + libav_reason(code)};
  }
  const AVFrame& frame = *codec.frame;
  if (frame.width != width_px_ || frame.height != height_px_ || frame.format != AV_PIX_FMT_RGBA) {
    return Error{"PNG is " + std::to_string(frame.width) + "x" + std::to_string(frame.height) +
                 " px, pixel format " + std::to_string(frame.format) + ", must be " +
                 std::to_string(width_px_) + "x" + std::to_string(height_px_) +
                 " px of 8-bit RGBA"};
  }
  bgra.clear();
  for (int y = 0; y < height_px_; ++y) {
    const std::uint8_t* row = frame.data[0] + std::ptrdiff_t{y} * frame.linesize[0];
    bgra.insert(bgra.end(), row, row + std::ptrdiff_t{4} * width_px_);
  }
  for (std::size_t i = 0; i + 3 < bgra.size(); i += 4) {
    std::swap(bgra[i], bgra[i + 2]);
  }
  return {};
}

}  // namespace orthonav::hl2ss
