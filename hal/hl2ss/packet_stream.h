#pragma once

#include "hal/hl2ss/arrival_meter.h"
#include "hal/hl2ss/boot_clock.h"
#include "hal/hl2ss/connection.h"
#include "hal/hl2ss/packet.h"

namespace orthonav::hl2ss {

/// What the streams of one headset share: its time.
struct HeadsetTime {
  StampReader stamps;
  BootClock clock;
};

/// A port that sends packets: cuts them out, tells their times, counts what is wrong with them.
class PacketStream : public Protocol {
 public:
  PacketStream(const std::string& name, const PacketFormat& format, ArrivalMeter& meter,
               HeadsetTime& time)
      : meter_(meter), assembler_(name, format), time_(time) {}
  std::span<std::uint8_t> room() final { return assembler_.room(); }
  Status received(std::size_t count, HostTime at) final;
  void disconnected() override { assembler_.restart(); }

 protected:
  struct Stamped {
    Timestamp time{};
    HostTime at{};
    bool in_order = true;    ///< after all packets before it
    bool is_trusted = true;  ///< `check_stamp` found nothing wrong
  };
  /// An Error says why the stamp must be wrong: the packet's time is then used for nothing.
  virtual Status check_stamp(const Packet& /*packet*/, Timestamp /*stamp*/) { return {}; }
  /// An Error says what was wrong with this packet; the stream goes on.
  virtual Status take(const Packet& packet, const Stamped& stamped) = 0;
  ArrivalMeter& meter_;

 private:
  PacketAssembler assembler_;
  HeadsetTime& time_;
};

}  // namespace orthonav::hl2ss
