#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// One packet of a stream; the spans look into the assembler.
struct Packet {
  std::uint64_t ticks = 0;  ///< of 100 ns, of the headset's boot clock
  Bytes payload;
  Bytes pose;  ///< 64 bytes, or none
};

struct PacketFormat {
  std::size_t max_payload = 0;  ///< a larger size means damage or an attack
  bool has_pose = false;
};

/// Splits a stream of bytes into packets, regardless of how the network divided it. Memory stays
/// below one largest packet plus one read.
class PacketAssembler {
 public:
  PacketAssembler(std::string stream, const PacketFormat& format);

  /// Room for the next bytes of the stream; `received` says how many were written there.
  std::span<std::uint8_t> room();
  void received(std::size_t count);
  /// No byte of a further packet was received.
  [[nodiscard]] bool is_empty() const { return begin_ == end_; }
  /// The next complete packet; nothing if more bytes are needed; an Error if a size is wrong, so
  /// that the start of the next packet is unknown. Valid until `room`.
  Result<std::optional<Packet>> next();
  /// Discards the received bytes.
  void restart();

 private:
  std::string stream_;
  PacketFormat format_;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace orthonav::hl2ss
