#include "hal/hl2ss/packet_port.h"

namespace orthonav::hl2ss {

Status PacketPort::received(std::size_t count, HostTime at) {
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
  }
}

}  // namespace orthonav::hl2ss
