#include "hal/hl2ss/packet_stream.h"

namespace orthonav::hl2ss {

Status PacketPort::received(std::size_t count, HostTime at) {
  if (assembler_.is_empty()) {
    began_ = at;
  }
  assembler_.received(count);
  for (;;) {
    const auto packet = assembler_.next();
    if (!packet) {
      return packet.error();
    }
    if (!*packet) {
      return {};
    }
    heard(**packet, at);
    began_ = at;
  }
}

void PacketStream::heard(const Packet& packet, HostTime at) {
  const auto time = time_.stamps.time_of(packet.ticks, at);
  if (!time) {
    meter_.refused("stamp " + std::to_string(packet.ticks) +
                   " is none, or more than 10 s from the one before");
    return left_out();
  }
  Stamped stamped{*time, at};
  if (const Status right = check_stamp(packet, time_.stamps.as_stamped(*time)); right) {
    // It may just have shown that the clock was set.
    stamped.time = time_.stamps.told(packet.ticks, at).value_or(*time);
    time_.clock.heard(stamped.time, began());
    meter_.heard(stamped.time, at);
  } else {
    stamped.is_trusted = false;
    meter_.refused(right.error().message);
  }
  if (const Status taken = take(packet, stamped); !taken) {
    meter_.damaged(taken.error().message);
  }
}

}  // namespace orthonav::hl2ss
