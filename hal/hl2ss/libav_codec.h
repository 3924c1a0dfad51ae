#pragma once

#include <string>

struct AVCodec;
struct AVCodecContext;
struct AVFrame;
struct AVPacket;

namespace orthonav::hl2ss {

/// What libavcodec needs to code or decode; freed when it goes.
struct LibavCodec {
  AVCodecContext* context = nullptr;
  AVFrame* frame = nullptr;
  AVPacket* packet = nullptr;

  LibavCodec() = default;
  ~LibavCodec();
  LibavCodec(const LibavCodec&) = delete;
  LibavCodec& operator=(const LibavCodec&) = delete;
  /// False when memory is short, or for no codec.
  [[nodiscard]] bool allocate(const AVCodec* codec);
};

/// What a code of libavcodec's means.
[[nodiscard]] std::string libav_reason(int code);

}  // namespace orthonav::hl2ss
