#pragma once

#include <span>
#include <string>

#include "hal/hl2ss/arrival_meter.h"
#include "hal/hl2ss/boot_clock.h"
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
  /// When the first byte of the packet arrived that `heard` takes.
  [[nodiscard]] HostTime began() const { return began_; }

 private:
  PacketAssembler assembler_;
  HostTime began_{};
};

/// The headset's time, which its streams share.
struct HeadsetTime {
  StampReader stamps;
  BootClock clock;
};

/// A port that sends packets: determines their times and counts faults.
class PacketStream : public PacketPort {
 public:
  PacketStream(const std::string& name, const PacketFormat& format, ArrivalMeter& meter,
               HeadsetTime& time)
      : PacketPort(name, format), meter_(meter), time_(time) {}

 protected:
  struct Stamped {
    Timestamp time{};
    HostTime at{};
    bool is_trusted = true;  ///< `check_stamp` found nothing wrong
  };
  /// An Error says why the stamp must be wrong: the packet's time is then not used. `stamp` is as
  /// if the headset's clock had never been set.
  virtual Status check_stamp(const Packet& /*packet*/, Timestamp /*stamp*/) { return {}; }
  /// A packet without a usable time is left out.
  virtual void left_out() {}
  /// An Error says what was wrong with this packet; the stream continues.
  virtual Status take(const Packet& packet, const Stamped& stamped) = 0;
  ArrivalMeter& meter_;

 private:
  void heard(const Packet& packet, HostTime at) final;

  HeadsetTime& time_;
};

}  // namespace orthonav::hl2ss
