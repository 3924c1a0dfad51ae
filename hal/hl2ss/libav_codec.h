#pragma once

#include <string>

struct AVCodec;
struct AVCodecContext;
struct AVFrame;
struct AVPacket;

namespace orthonav::hl2ss {

/// The objects that libavcodec needs to encode or decode; freed on destruction.
struct LibavCodec {
  AVCodecContext* context = nullptr;
  AVFrame* frame = nullptr;
  AVPacket* packet = nullptr;

  LibavCodec() = default;
  ~LibavCodec();
  LibavCodec(const LibavCodec&) = delete;
  LibavCodec& operator=(const LibavCodec&) = delete;
  /// False if memory is short or `codec` is null.
  [[nodiscard]] bool allocate(const AVCodec* codec);
};

/// The meaning of an error code of libavcodec.
[[nodiscard]] std::string libav_reason(int code);

}  // namespace orthonav::hl2ss
