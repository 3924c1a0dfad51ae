#include "hal/hl2ss/packet_stream.h"

namespace orthonav::hl2ss {

Status PacketStream::received(std::size_t count, HostTime at) {
  assembler_.received(count);
  for (;;) {
    const auto packet = assembler_.next();
    if (!packet) {
      return packet.error();
    }
    if (!*packet) {
      return {};
    }
    const auto time = time_.stamps.time_of((*packet)->ticks, at);
    if (!time) {
      meter_.damaged("stamp " + std::to_string((*packet)->ticks) + " lies outside its time");
      continue;
    }
    time_.clock.heard(*time, at);
    const bool in_order = meter_.heard(*time, at);
    if (const Status taken = take(**packet, {*time, at, in_order}); !taken) {
      meter_.damaged(taken.error().message);
    }
  }
}

}  // namespace orthonav::hl2ss
