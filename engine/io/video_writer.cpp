#include "engine/io/video_writer.h"

#include <utility>

#include "engine/io/atomic_file.h"
#include "engine/io/av_error.h"
#include "engine/io/video_remux.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace orthonav::engine {

namespace {

Status check(const std::string& path, const VideoOptions& o) {
  if (o.width_px < 16 || o.height_px < 16 || o.width_px % 2 != 0 || o.height_px % 2 != 0) {
    return Error{path + ": video size " + std::to_string(o.width_px) + "x" +
                 std::to_string(o.height_px) + " must be even and at least 16x16"};
  }
  if (o.frames_per_second < 1 || o.frames_per_second > 240) {
    return Error{path + ": " + std::to_string(o.frames_per_second) +
                 " frames per second, limits 1 to 240"};
  }
  return {};
}

}  // namespace

struct VideoWriter::Encoder {
  Encoder(AtomicFile to, const VideoOptions& chosen, std::string name)
      : path(std::move(name)), file(std::move(to)), options(chosen) {}

  std::string path;
  AtomicFile file;
  VideoOptions options;
  AVFormatContext* format = nullptr;
  AVCodecContext* codec = nullptr;
  AVStream* stream = nullptr;
  AVFrame* frame = nullptr;
  AVPacket* packet = nullptr;
  SwsContext* scaler = nullptr;
  std::int64_t frames = 0;
  bool finished = false;
  bool kept = false;  ///< cut off, and left under its temporary name

  ~Encoder() {
    sws_freeContext(scaler);
    av_packet_free(&packet);
    av_frame_free(&frame);
    avcodec_free_context(&codec);
    if (format != nullptr) {
      avio_closep(&format->pb);
      avformat_free_context(format);
    }
  }

  Status open_codec();
  Status open_file();
  Status write_header();
  Status open_frame();
  Status drain();
  Status put_in_place();
  /// Leaves the written part, which can be played, where it is; the Error says where.
  Error cut_off(const Error& why);
};

Status VideoWriter::Encoder::open_codec() {
  const AVCodec* h264 = avcodec_find_encoder_by_name("libx264");
  if (h264 == nullptr) {
    return Error{path + ": libavcodec has no H.264 encoder (libx264)"};
  }
  codec = avcodec_alloc_context3(h264);
  if (codec == nullptr) {
    return Error{path + ": out of memory for the H.264 encoder"};
  }
  codec->width = options.width_px;
  codec->height = options.height_px;
  codec->time_base = {1, options.frames_per_second};
  codec->framerate = {options.frames_per_second, 1};
  codec->pix_fmt = AV_PIX_FMT_YUV420P;
  codec->thread_count = options.threads;
  // A fixed number of threads, and nothing that depends on time: the same pictures give the same
  // bytes.
  const std::string quality = std::to_string(options.quality);
  for (const auto& [key, value] : {std::pair{"preset", "veryfast"}, {"crf", quality.c_str()}}) {
    if (const int code = av_opt_set(codec->priv_data, key, value, 0); code < 0) {
      return av_error(path, std::string("H.264 encoder refused ") + key + " " + value, code);
    }
  }
  if ((format->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
    codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  }
  if (const int code = avcodec_open2(codec, h264, nullptr); code < 0) {
    return av_error(path, "H.264 encoder refused the settings", code);
  }
  return {};
}

Status VideoWriter::Encoder::open_file() {
  if (const int code =
          avformat_alloc_output_context2(&format, nullptr, "mp4", file.temporary_path().c_str());
      code < 0) {
    return av_error(path, "no MP4 writer", code);
  }
  if (const Status opened = open_codec(); !opened) {
    return opened;
  }
  stream = avformat_new_stream(format, nullptr);
  if (stream == nullptr) {
    return Error{path + ": out of memory for a video stream"};
  }
  stream->time_base = codec->time_base;
  if (const int code = avcodec_parameters_from_context(stream->codecpar, codec); code < 0) {
    return av_error(path, "cannot describe its stream", code);
  }
  if (const int code = avio_open(&format->pb, file.temporary_path().c_str(), AVIO_FLAG_WRITE);
      code < 0) {
    return av_error(path, "cannot be written", code);
  }
  if (const Status begun = write_header(); !begun) {
    return begun;
  }
  return open_frame();
}

Status VideoWriter::Encoder::write_header() {
  AVDictionary* movie = nullptr;
  // Each picture is a fragment of its own, handed to the system once it is encoded: a film that is
  // cut off anywhere plays up to there.
  format->flags |= AVFMT_FLAG_FLUSH_PACKETS;
  int code = av_dict_set(&movie, "movflags", "frag_every_frame+empty_moov+default_base_moof", 0);
  if (code >= 0) {
    code = avformat_write_header(format, &movie);
  }
  av_dict_free(&movie);
  if (code < 0) {
    return av_error(path, "cannot be started", code);
  }
  return {};
}

Status VideoWriter::Encoder::open_frame() {
  frame = av_frame_alloc();
  packet = av_packet_alloc();
  if (frame == nullptr || packet == nullptr) {
    return Error{path + ": out of memory for a video frame"};
  }
  frame->format = codec->pix_fmt;
  frame->width = options.width_px;
  frame->height = options.height_px;
  if (av_frame_get_buffer(frame, 0) < 0) {
    return Error{path + ": out of memory for a video frame"};
  }
  scaler =
      sws_getContext(options.width_px, options.height_px, AV_PIX_FMT_RGBA, options.width_px,
                     options.height_px, AV_PIX_FMT_YUV420P, SWS_POINT, nullptr, nullptr, nullptr);
  if (scaler == nullptr) {
    return Error{path + ": no conversion from RGBA to YUV 4:2:0"};
  }
  return {};
}

Status VideoWriter::Encoder::drain() {
  for (;;) {
    const int code = avcodec_receive_packet(codec, packet);
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) {
      return {};
    }
    if (code < 0) {
      return av_error(path, "encoding failed", code);
    }
    av_packet_rescale_ts(packet, codec->time_base, stream->time_base);
    packet->stream_index = stream->index;
    if (const int written = av_interleaved_write_frame(format, packet); written < 0) {
      return av_error(path, "writing failed", written);
    }
  }
}

Error VideoWriter::Encoder::cut_off(const Error& why) {
  if (format != nullptr && format->pb != nullptr) {
    avio_flush(format->pb);
  }
  kept = kept || file.keep();
  return kept ? Error{why.message + "; what was written plays: " + file.temporary_path(), why.code}
              : why;
}

/// Copies the film once more with its index in front, so that players know its length. If there is
/// no room for a copy, the fragmented film becomes the file as it is.
Status VideoWriter::Encoder::put_in_place() {
  if (file.temporary_path() == file.final_path()) {  // a pipe
    return file.commit();
  }
  auto whole = AtomicFile::create(path);
  if (whole && remux_video(file.temporary_path(), whole->temporary_path(), path)) {
    return whole->commit();
  }
  return file.commit();
}

VideoWriter::VideoWriter(std::unique_ptr<Encoder> encoder) : encoder_(std::move(encoder)) {}
VideoWriter::~VideoWriter() = default;

Result<std::unique_ptr<VideoWriter>> VideoWriter::create(const std::string& path,
                                                         const VideoOptions& options) {
  if (const Status status = check(path, options); !status) {
    return status.error();
  }
  // The library must not print; problems are returned as an Error.
  av_log_set_level(AV_LOG_QUIET);
  auto file = AtomicFile::create(path, Staging::kBeside);
  if (!file) {
    return file.error();
  }
  auto encoder = std::make_unique<Encoder>(std::move(*file), options, path);
  if (const Status status = encoder->open_file(); !status) {
    return status.error();
  }
  return std::unique_ptr<VideoWriter>(new VideoWriter(std::move(encoder)));
}

Status VideoWriter::write(const RgbaImage& picture) {
  Encoder& e = *encoder_;
  if (e.kept) {
    return Error{e.path + ": was cut off before"};
  }
  const auto bytes = 4 * static_cast<std::size_t>(e.options.width_px) *
                     static_cast<std::size_t>(e.options.height_px);
  if (picture.width_px != e.options.width_px || picture.height_px != e.options.height_px ||
      picture.pixels.size() < bytes) {
    return Error{e.path + ": picture of " + std::to_string(picture.width_px) + "x" +
                 std::to_string(picture.height_px) + " in a video of " +
                 std::to_string(e.options.width_px) + "x" + std::to_string(e.options.height_px)};
  }
  if (av_frame_make_writable(e.frame) < 0) {
    return Error{e.path + ": out of memory"};
  }
  const std::uint8_t* rows[1] = {picture.pixels.data()};
  const int stride[1] = {4 * picture.width_px};
  if (const int lines =
          sws_scale(e.scaler, rows, stride, 0, picture.height_px, e.frame->data, e.frame->linesize);
      lines != picture.height_px) {
    return Error{e.path + ": conversion of a picture ended after " + std::to_string(lines) +
                 " lines"};
  }
  e.frame->pts = e.frames++;
  if (const int code = avcodec_send_frame(e.codec, e.frame); code < 0) {
    return av_error(e.path, "encoding failed", code);
  }
  const Status drained = e.drain();
  return drained ? drained : Status(e.cut_off(drained.error()));
}

Status VideoWriter::finish() {
  Encoder& e = *encoder_;
  if (e.finished) {
    return {};
  }
  if (e.kept) {
    return Error{e.path + ": was cut off before"};
  }
  if (e.frames == 0) {
    return Error{e.path + ": no picture was written"};
  }
  if (const int code = avcodec_send_frame(e.codec, nullptr); code < 0) {
    return av_error(e.path, "encoding failed", code);
  }
  if (const Status drained = e.drain(); !drained) {
    return e.cut_off(drained.error());
  }
  if (const int code = av_write_trailer(e.format); code < 0) {
    return e.cut_off(av_error(e.path, "cannot be completed", code));
  }
  // Closing writes the buffered rest, so a full disk is noticed here.
  if (const int code = avio_closep(&e.format->pb); code < 0) {
    return e.cut_off(av_error(e.path, "cannot be completed", code));
  }
  if (const Status placed = e.put_in_place(); !placed) {
    return e.cut_off(placed.error());
  }
  e.finished = true;
  return {};
}

std::int64_t VideoWriter::frames() const { return encoder_->frames; }

}  // namespace orthonav::engine
