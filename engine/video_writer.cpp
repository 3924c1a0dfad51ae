#include "engine/video_writer.h"

#include <cstdio>
#include <filesystem>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace orthonav::engine {
namespace {

Error av_error(const std::string& path, const std::string& what, int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  return Error{path + ": " + what + " (" + text + ")"};
}

Status check(const std::string& path, const VideoOptions& o) {
  if (o.width_px < 16 || o.height_px < 16 || o.width_px % 2 != 0 || o.height_px % 2 != 0)
    return Error{path + ": video size " + std::to_string(o.width_px) + "x" +
                 std::to_string(o.height_px) + " must be even and at least 16x16"};
  if (o.frames_per_second < 1 || o.frames_per_second > 240)
    return Error{path + ": " + std::to_string(o.frames_per_second) +
                 " frames per second, limits 1 to 240"};
  return {};
}

}  // namespace

struct VideoWriter::Encoder {
  std::string path;
  std::string part;
  VideoOptions options;
  AVFormatContext* format = nullptr;
  AVCodecContext* codec = nullptr;
  AVStream* stream = nullptr;
  AVFrame* frame = nullptr;
  AVPacket* packet = nullptr;
  SwsContext* scaler = nullptr;
  std::int64_t frames = 0;
  bool finished = false;

  ~Encoder() {
    sws_freeContext(scaler);
    av_packet_free(&packet);
    av_frame_free(&frame);
    avcodec_free_context(&codec);
    if (format != nullptr) {
      avio_closep(&format->pb);
      avformat_free_context(format);
    }
    if (!finished) std::remove(part.c_str());
  }

  Status open_codec();
  Status open_file();
  Status drain();
};

Status VideoWriter::Encoder::open_codec() {
  const AVCodec* h264 = avcodec_find_encoder_by_name("libx264");
  if (h264 == nullptr) return Error{path + ": libavcodec has no H.264 encoder (libx264)"};
  codec = avcodec_alloc_context3(h264);
  codec->width = options.width_px;
  codec->height = options.height_px;
  codec->time_base = {1, options.frames_per_second};
  codec->framerate = {options.frames_per_second, 1};
  codec->pix_fmt = AV_PIX_FMT_YUV420P;
  codec->thread_count = options.threads;
  // Fixed reference threads and no timing: the same pictures give the same bytes.
  av_opt_set(codec->priv_data, "preset", "veryfast", 0);
  av_opt_set(codec->priv_data, "crf", std::to_string(options.quality).c_str(), 0);
  if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0)
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  if (const int code = avcodec_open2(codec, h264, nullptr); code < 0)
    return av_error(path, "H.264 encoder refused the settings", code);
  return {};
}

Status VideoWriter::Encoder::open_file() {
  if (const int code = avformat_alloc_output_context2(&format, nullptr, "mp4", part.c_str());
      code < 0)
    return av_error(path, "no MP4 writer", code);
  if (const Status opened = open_codec(); !opened) return opened;
  stream = avformat_new_stream(format, nullptr);
  stream->time_base = codec->time_base;
  avcodec_parameters_from_context(stream->codecpar, codec);
  if (const int code = avio_open(&format->pb, part.c_str(), AVIO_FLAG_WRITE); code < 0)
    return av_error(path, "cannot be written", code);
  AVDictionary* movie = nullptr;
  av_dict_set(&movie, "movflags", "faststart", 0);
  const int code = avformat_write_header(format, &movie);
  av_dict_free(&movie);
  if (code < 0) return av_error(path, "cannot be started", code);
  frame = av_frame_alloc();
  frame->format = codec->pix_fmt;
  frame->width = options.width_px;
  frame->height = options.height_px;
  if (av_frame_get_buffer(frame, 0) < 0) return Error{path + ": out of memory for a video frame"};
  packet = av_packet_alloc();
  scaler =
      sws_getContext(options.width_px, options.height_px, AV_PIX_FMT_RGBA, options.width_px,
                     options.height_px, AV_PIX_FMT_YUV420P, SWS_POINT, nullptr, nullptr, nullptr);
  return {};
}

Status VideoWriter::Encoder::drain() {
  for (;;) {
    const int code = avcodec_receive_packet(codec, packet);
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
    if (code < 0) return av_error(path, "encoding failed", code);
    av_packet_rescale_ts(packet, codec->time_base, stream->time_base);
    packet->stream_index = stream->index;
    if (const int written = av_interleaved_write_frame(format, packet); written < 0)
      return av_error(path, "writing failed", written);
  }
}

VideoWriter::VideoWriter() : encoder_(std::make_unique<Encoder>()) {}
VideoWriter::~VideoWriter() = default;

Result<std::unique_ptr<VideoWriter>> VideoWriter::create(const std::string& path,
                                                         const VideoOptions& options) {
  if (const Status status = check(path, options); !status) return status.error();
  av_log_set_level(AV_LOG_ERROR);
  std::unique_ptr<VideoWriter> writer(new VideoWriter());
  writer->encoder_->path = path;
  writer->encoder_->part = path + ".part";
  writer->encoder_->options = options;
  if (const Status status = writer->encoder_->open_file(); !status) return status.error();
  return writer;
}

Status VideoWriter::write(const RgbaImage& picture) {
  Encoder& e = *encoder_;
  if (picture.width_px != e.options.width_px || picture.height_px != e.options.height_px)
    return Error{e.path + ": picture of " + std::to_string(picture.width_px) + "x" +
                 std::to_string(picture.height_px) + " in a video of " +
                 std::to_string(e.options.width_px) + "x" + std::to_string(e.options.height_px)};
  if (av_frame_make_writable(e.frame) < 0) return Error{e.path + ": out of memory"};
  const std::uint8_t* rows[1] = {picture.pixels.data()};
  const int stride[1] = {4 * picture.width_px};
  sws_scale(e.scaler, rows, stride, 0, picture.height_px, e.frame->data, e.frame->linesize);
  e.frame->pts = e.frames++;
  if (const int code = avcodec_send_frame(e.codec, e.frame); code < 0)
    return av_error(e.path, "encoding failed", code);
  return e.drain();
}

Status VideoWriter::finish() {
  Encoder& e = *encoder_;
  if (e.finished) return {};
  if (e.frames == 0) return Error{e.path + ": no picture was written"};
  avcodec_send_frame(e.codec, nullptr);
  if (const Status drained = e.drain(); !drained) return drained;
  if (const int code = av_write_trailer(e.format); code < 0)
    return av_error(e.path, "cannot be completed", code);
  avio_closep(&e.format->pb);
  std::error_code failure;
  std::filesystem::rename(e.part, e.path, failure);
  if (failure) return Error{e.path + ": cannot be put in place (" + failure.message() + ")"};
  e.finished = true;
  return {};
}

std::int64_t VideoWriter::frames() const { return encoder_->frames; }

}  // namespace orthonav::engine
