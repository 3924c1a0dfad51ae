#include "hal/hl2ss/packet.h"

#include <cstring>

#include "hal/hl2ss/protocol.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kReadBytes = std::size_t{64} * 1024;

}  // namespace

PacketAssembler::PacketAssembler(std::string stream, const PacketFormat& format)
    : stream_(std::move(stream)),
      format_(format),
      buffer_(kPacketHeaderBytes + format.max_payload + kPoseBytes + kReadBytes) {}

std::span<std::uint8_t> PacketAssembler::room() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  return std::span(buffer_).subspan(end_);
}

void PacketAssembler::received(std::size_t count) { end_ += count; }

Result<std::optional<Packet>> PacketAssembler::next() {
  const Bytes waiting(buffer_.data() + begin_, end_ - begin_);
  if (waiting.size() < kPacketHeaderBytes) {
    return std::optional<Packet>{};
  }
  const auto size = number_at<std::uint32_t>(waiting, 8);
  if (size > format_.max_payload) {
    return Error{stream_ + ": payload of " + std::to_string(size) + " bytes, limit " +
                 std::to_string(format_.max_payload)};
  }
  const std::size_t pose_bytes = format_.has_pose ? kPoseBytes : 0;
  const std::size_t whole = kPacketHeaderBytes + size + pose_bytes;
  if (waiting.size() < whole) {
    return std::optional<Packet>{};
  }
  begin_ += whole;
  return std::optional<Packet>({number_at<std::uint64_t>(waiting, 0),
                                waiting.subspan(kPacketHeaderBytes, size),
                                waiting.subspan(kPacketHeaderBytes + size, pose_bytes)});
}

void PacketAssembler::restart() { begin_ = end_ = 0; }

}  // namespace orthonav::hl2ss
