#include "engine/io/video_remux.h"

#include "engine/io/av_error.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace orthonav::engine {
namespace {

class Remux {
 public:
  explicit Remux(const std::string& name) : name_(name) {}
  Remux(const Remux&) = delete;
  Remux& operator=(const Remux&) = delete;
  ~Remux() {
    av_packet_free(&packet_);
    avformat_close_input(&in_);
    if (out_ != nullptr) {
      avio_closep(&out_->pb);
      avformat_free_context(out_);
    }
  }

  Status open(const std::string& from, const std::string& to) {
    if (const int code = avformat_open_input(&in_, from.c_str(), nullptr, nullptr); code < 0) {
      return av_error(name_, "cannot be read again", code);
    }
    if (in_->nb_streams != 1) {
      return Error{name_ + ": has " + std::to_string(in_->nb_streams) + " streams, must have 1"};
    }
    packet_ = av_packet_alloc();
    if (const int code = avformat_alloc_output_context2(&out_, nullptr, "mp4", to.c_str());
        code < 0 || packet_ == nullptr) {
      return av_error(name_, "no MP4 writer", code);
    }
    AVStream* stream = avformat_new_stream(out_, nullptr);
    if (stream == nullptr ||
        avcodec_parameters_copy(stream->codecpar, in_->streams[0]->codecpar) < 0) {
      return Error{name_ + ": out of memory for a video stream"};
    }
    stream->time_base = in_->streams[0]->time_base;
    stream->avg_frame_rate = in_->streams[0]->avg_frame_rate;
    if (const int code = avio_open(&out_->pb, to.c_str(), AVIO_FLAG_WRITE); code < 0) {
      return av_error(name_, "cannot be written", code);
    }
    AVDictionary* movie = nullptr;
    int code = av_dict_set(&movie, "movflags", "faststart", 0);
    code = code < 0 ? code : avformat_write_header(out_, &movie);
    av_dict_free(&movie);
    return code < 0 ? Status(av_error(name_, "cannot be started", code)) : Status{};
  }

  Status copy() {
    std::int64_t first = AV_NOPTS_VALUE;
    for (;;) {
      const int code = av_read_frame(in_, packet_);
      if (code == AVERROR_EOF) {
        break;
      }
      if (code < 0) {
        return av_error(name_, "cannot be read again", code);
      }
      // The first picture is a key frame, and shown first.
      first = first == AV_NOPTS_VALUE ? packet_->pts : first;
      packet_->pts -= first;
      packet_->dts -= first;
      av_packet_rescale_ts(packet_, in_->streams[0]->time_base, out_->streams[0]->time_base);
      packet_->stream_index = 0;
      packet_->pos = -1;
      if (const int written = av_interleaved_write_frame(out_, packet_); written < 0) {
        return av_error(name_, "writing failed", written);
      }
    }
    if (const int code = av_write_trailer(out_); code < 0) {
      return av_error(name_, "cannot be completed", code);
    }
    // Closing writes the buffered rest, so a full disk is noticed here.
    const int code = avio_closep(&out_->pb);
    return code < 0 ? Status(av_error(name_, "cannot be completed", code)) : Status{};
  }

 private:
  std::string name_;
  AVFormatContext* in_ = nullptr;
  AVFormatContext* out_ = nullptr;
  AVPacket* packet_ = nullptr;
};

}  // namespace

Status remux_video(const std::string& from, const std::string& to, const std::string& name) {
  Remux remux(name);
  if (Status opened = remux.open(from, to); !opened) {
    return opened;
  }
  return remux.copy();
}

}  // namespace orthonav::engine
