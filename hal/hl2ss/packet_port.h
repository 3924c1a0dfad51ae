#pragma once

#include <span>
#include <string>

#include "hal/hl2ss/connection.h"
#include "hal/hl2ss/packet.h"

namespace orthonav::hl2ss {

/// A port that sends packets: splits its bytes into packets.
class PacketPort : public Protocol {
 public:
  PacketPort(const std::string& name, const PacketFormat& format) : assembler_(name, format) {}
  std::span<std::uint8_t> room() final { return assembler_.room(); }
  Status received(std::size_t count, HostTime at) final;
  void disconnected() override { assembler_.restart(); }

 protected:
  /// Takes a complete packet; the stream continues even if something is wrong with it.
  virtual void heard(const Packet& packet, HostTime at) = 0;

 private:
  PacketAssembler assembler_;
};

}  // namespace orthonav::hl2ss
