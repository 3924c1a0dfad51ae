#include "hal/hl2ss/libav_codec.h"

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace orthonav::hl2ss {

LibavCodec::~LibavCodec() {
  av_packet_free(&packet);
  av_frame_free(&frame);
  avcodec_free_context(&context);
}

bool LibavCodec::allocate(const AVCodec* codec) {
  if (codec == nullptr) {
    return false;
  }
  context = avcodec_alloc_context3(codec);
  frame = av_frame_alloc();
  packet = av_packet_alloc();
  return context != nullptr && frame != nullptr && packet != nullptr;
}

std::string libav_reason(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  return text;
}

}  // namespace orthonav::hl2ss
